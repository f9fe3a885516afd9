// SPDX-License-Identifier: Apache-2.0
// Errors of the JSON text: the code, the line and the column.
#include <gltfx/pipeline.hpp>

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "rules/verdict.hpp"

namespace gltfx {
namespace {

struct TextCase {
  const char* name;
  std::string text;
  const char* code;
  std::uint32_t line;
  std::uint32_t column;
};

void PrintTo(const TextCase& one, std::ostream* out) { *out << one.name; }

class TextErrors : public ::testing::TestWithParam<TextCase> {};

TEST_P(TextErrors, NameTheirPlace) {
  const TextCase& wanted = GetParam();
  const FileReport report = validate_bytes(wanted.text, "test.gltf");
  ASSERT_EQ(report.diagnostics.size(), 1U);
  const Diagnostic& found = report.diagnostics[0];
  EXPECT_EQ(found.code, wanted.code);
  EXPECT_EQ(found.location.line, wanted.line);
  EXPECT_EQ(found.location.column, wanted.column);
  EXPECT_EQ(found.pointer, "");
}

const std::string kAsset = "{\"asset\": {\"version\": \"2.0\"}";

INSTANTIATE_TEST_SUITE_P(
    Json, TextErrors,
    ::testing::Values(
        TextCase{"trailing_comma", "{\n \"asset\": {\"version\": \"2.0\",}\n}",
                 "JSON_TRAILING_COMMA", 2, 28},
        TextCase{"missing_comma", "{\"asset\": {\"version\": \"2.0\"}\n \"extras\": {}}",
                 "JSON_MISSING_COMMA", 2, 2},
        TextCase{"trailing_data", kAsset + "}\n}", "JSON_TRAILING_DATA", 2, 1},
        TextCase{"duplicate_key", "{\"asset\": {\"version\": \"2.0\", \"version\": \"2.0\"}}",
                 "JSON_DUPLICATE_KEY", 1, 30},
        TextCase{"escaped_duplicate",
                 "{\"asset\": {\"version\": \"2.0\", \"v\\u0065rsion\": \"2.0\"}}",
                 "JSON_DUPLICATE_KEY", 1, 30},
        TextCase{"bom", "\xef\xbb\xbf" + kAsset + "}", "JSON_BYTE_ORDER_MARK", 1, 1},
        TextCase{"lone_surrogate", kAsset + ", \"extras\": {\"a\": \"\\ud800\"}}",
                 "JSON_LONE_SURROGATE", 1, 48},
        TextCase{"out_of_range", kAsset + ", \"extras\": {\"a\": 1e400}}",
                 "JSON_NUMBER_OUT_OF_RANGE", 1, 47},
        TextCase{"bad_utf8", "{\"asset\": {\"version\": \"2.0\", \"generator\": \"\xff\"}}",
                 "JSON_INVALID_UTF8", 1, 44},
        TextCase{"columns_count_characters",
                 "{\"asset\": {\"version\": \"2.0\", \"generator\": \"\xc3\xa9\xc3\xa9\"}, tru}",
                 "INVALID_JSON", 1, 50},
        TextCase{"too_deep", std::string(2000, '['), "JSON_TOO_DEEP", 1, 1025},
        TextCase{"unclosed", "{\"asset\": {\"version\": \"2.0\"}", "INVALID_JSON", 1, 29}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(TextErrors, RecoverableOnesDoNotHideTheRest) {
  const std::vector<std::string> wanted{"JSON_TRAILING_COMMA ", "UNEXPECTED_PROPERTY /asset/x"};
  EXPECT_EQ(test::verdict(R"({"asset": {"version": "2.0", "x": 1,}})"), wanted);
}

TEST(TextErrors, KhronosProfileGivesUpAtTheFirst) {
  const std::vector<std::string> wanted{"INVALID_JSON "};
  EXPECT_EQ(test::verdict(R"({"asset": {"version": "2.0", "x": 1,}})", Profile::khronos), wanted);
}

TEST(TextErrors, KhronosProfileKnowsNoMediaTypeOfWhatItDoesNotRead) {
  ValidateOptions options;
  EXPECT_EQ(validate_bytes(kAsset + ",}", "a.gltf", options).mime_type, "model/gltf+json");
  options.profile = Profile::khronos;
  EXPECT_EQ(validate_bytes(kAsset + ",}", "a.gltf", options).mime_type, "");
  EXPECT_EQ(validate_bytes("\xef\xbb\xbf" + kAsset + "}", "a.gltf", options).mime_type,
            "model/gltf+json");
}

TEST(TextErrors, KhronosProfileReadsOnBehindAByteOrderMark) {
  const std::vector<std::string> wanted{"INVALID_JSON ", "UNEXPECTED_PROPERTY /asset/x"};
  const std::string text =
      "\xef\xbb\xbf"
      R"({"asset": {"version": "2.0", "x": 1}})";
  EXPECT_EQ(test::verdict(text, Profile::khronos), wanted);
}

// Earlier values are not checked: of the indices of one attribute, only the last one is valid.
TEST(TextErrors, OfEqualKeysTheLastValueIsJudged) {
  const auto with = [](const std::string& attributes, const std::string& more) {
    return R"({"asset": {"version": "2.0"}, "meshes": [{"primitives": [{"attributes": {)" +
           attributes + "}}]}], \"accessors\": [" + more +
           R"({"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}]})";
  };
  ValidateOptions options;
  options.ignore = {"UNUSED_OBJECT", "ACCESSOR_WITHOUT_DATA"};
  const std::string sound = R"("POSITION": 9, "POSITION": 0)";
  const std::string place = "/meshes/0/primitives/0/attributes/POSITION";
  using Lines = std::vector<std::string>;
  const auto found = [&](const std::string& attributes) {
    Lines lines = test::verdict(with(attributes, ""), options);
    std::erase_if(lines, [](const std::string& line) {
      return !line.ends_with("POSITION") && !line.starts_with("JSON");
    });
    return lines;
  };
  EXPECT_EQ(found(sound), Lines{"JSON_DUPLICATE_KEY "});
  EXPECT_EQ(found(R"("POSITION": 0, "POSITION": 9)"),
            (Lines{"JSON_DUPLICATE_KEY ", "UNRESOLVED_REFERENCE " + place}));
  EXPECT_EQ(found(R"("POSITION": 9, "POSITION": 9, "POSITION": 0)"),
            (Lines{"JSON_DUPLICATE_KEY ", "JSON_DUPLICATE_KEY "}));
  options.profile = Profile::khronos;
  EXPECT_EQ(found(sound), Lines{});
  EXPECT_EQ(found(R"("POSITION": 0, "POSITION": 9)"), Lines{"UNRESOLVED_REFERENCE " + place});
}

TEST(TextErrors, KhronosProfileTakesTheLastOfTwoKeysInSilence) {
  EXPECT_TRUE(test::verdict(R"({"asset": {"version": "1.0", "version": "2.0"}})", Profile::khronos)
                  .empty());
}

}  // namespace
}  // namespace gltfx
