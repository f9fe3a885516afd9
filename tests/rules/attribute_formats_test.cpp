// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "selected.hpp"

namespace gltfx::test {
namespace {

const std::string kAttributeAt = "/meshes/0/primitives/0/attributes/";

// "5121n VEC4" as an accessor: n for normalized.
std::string accessor(const std::string& format) {
  const bool normalized = format[4] == 'n';
  return R"({"count": 3, "componentType": )" + format.substr(0, 4) + R"(, "type": ")" +
         format.substr(normalized ? 6 : 5) + "\"" + (normalized ? R"(, "normalized": true})" : "}");
}

Lines of_format(const std::string& name, const std::string& format,
                const std::string& extension = {}, Profile profile = Profile::standard) {
  const std::string used = extension.empty()
                               ? ""
                               : R"("extensionsUsed": [")" + extension +
                                     R"("], "extensionsRequired": [")" + extension + "\"], ";
  return selected(
      asset_with(used + R"("accessors": [)" + accessor(format) +
                 R"(], "meshes": [{"primitives": [{"attributes": {")" + name + R"(": 0}}]}])"),
      {"MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT",
       "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT"},
      profile);
}

bool good(const std::string& name, const std::string& format, const std::string& extension = {}) {
  const Lines found = of_format(name, format, extension);
  if (found.empty()) return true;
  EXPECT_EQ(found,
            Lines{"MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT " + kAttributeAt + name});
  return false;
}

TEST(AttributeFormats, AreThoseOfTheSpecification) {
  const std::vector<std::string> formats{
      "5120 VEC2",  "5120n VEC2", "5121 VEC2", "5121n VEC2", "5122 VEC3", "5122n VEC3",
      "5123 VEC3",  "5123n VEC3", "5126 VEC2", "5126 VEC3",  "5126 VEC4", "5126 SCALAR",
      "5121 VEC3",  "5121n VEC3", "5121 VEC4", "5121n VEC4", "5123 VEC4", "5123n VEC4",
      "5123n VEC2", "5122n VEC4", "5125 VEC4"};
  const std::map<std::string, std::set<std::string>> allowed{
      {"POSITION", {"5126 VEC3"}},
      {"NORMAL", {"5126 VEC3"}},
      {"TANGENT", {"5126 VEC4"}},
      {"TEXCOORD_0", {"5126 VEC2", "5121n VEC2", "5123n VEC2"}},
      {"COLOR_0",
       {"5126 VEC3", "5126 VEC4", "5121n VEC3", "5121n VEC4", "5123n VEC3", "5123n VEC4"}},
      {"JOINTS_0", {"5121 VEC4", "5123 VEC4"}},
      {"WEIGHTS_0", {"5126 VEC4", "5121n VEC4", "5123n VEC4"}}};
  for (const auto& [name, set] : allowed) {
    for (const std::string& format : formats) {
      EXPECT_EQ(good(name, format), set.count(format) == 1) << name << " " << format;
    }
  }
}

TEST(AttributeFormats, ExtensionsAddSome) {
  const std::string quantization = "KHR_mesh_quantization";
  EXPECT_FALSE(good("POSITION", "5121 VEC3"));
  EXPECT_TRUE(good("POSITION", "5121 VEC3", quantization));
  EXPECT_TRUE(good("TEXCOORD_1", "5122 VEC2", quantization));
  EXPECT_FALSE(good("NORMAL", "5120 VEC3", quantization));
  EXPECT_TRUE(good("NORMAL", "5120n VEC3", quantization));
  const std::string splat = "KHR_gaussian_splatting";
  EXPECT_TRUE(good(splat + ":ROTATION", "5126 VEC4", splat));
  EXPECT_FALSE(good(splat + ":ROTATION", "5126 VEC3", splat));
}

TEST(AttributeFormats, TheHelpNamesTheExtensionThatAllowsOne) {
  const std::string asset =
      asset_with(R"("accessors": [)" + accessor("5123 VEC3") +
                 R"(], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}])");
  const std::string code = "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT";
  EXPECT_EQ(message(asset, code),
            "'POSITION' is VEC3 of UNSIGNED_SHORT; it must be VEC3 of FLOAT.");
  EXPECT_EQ(
      help(asset, code),
      "add KHR_mesh_quantization to extensionsUsed and extensionsRequired: it allows this format");
}

TEST(AttributeFormats, AttributesOfOnesOwnMayBeAnythingBut32BitIntegers) {
  EXPECT_EQ(of_format("_A", "5120 MAT3"), Lines{});
  EXPECT_EQ(of_format("_A", "5125 SCALAR"),
            Lines{"MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT " + kAttributeAt + "_A"});
}

TEST(AttributeFormats, AttributesWithAWrongNameAreOnlyJudgedInTheKhronosProfile) {
  EXPECT_EQ(of_format("NORMAL_0", "5126 VEC4"), Lines{});
  EXPECT_EQ(
      of_format("NORMAL_0", "5126 VEC4", "", Profile::khronos),
      Lines{"MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT " + kAttributeAt + "NORMAL_0"});
}

TEST(AttributeFormats, AnUnknownFormatIsNotJudged) {
  EXPECT_EQ(of_format("NORMAL", "5199 VEC3"), Lines{});
  EXPECT_EQ(of_format("NORMAL", "5126 VEC9"), Lines{});
}

// --- Bounds ---

Lines without_bounds(const std::string& bounds, Profile profile = Profile::standard) {
  return places(
      asset_with(R"("accessors": [{"count": 3, "componentType": 5126, "type": "VEC3")" + bounds +
                 R"(}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}])"),
      "MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS", profile);
}

TEST(AttributeBounds, PositionsHaveMinAndMax) {
  EXPECT_EQ(without_bounds(""), Lines{kAttributeAt + "POSITION"});
  EXPECT_EQ(without_bounds(R"(, "min": [0, 0, 0])"), Lines{kAttributeAt + "POSITION"});
  EXPECT_EQ(without_bounds(R"(, "max": [0, 0, 0])"), Lines{kAttributeAt + "POSITION"});
  EXPECT_EQ(without_bounds(R"(, "min": [0, 0, 0], "max": [0, 0, 0])"), Lines{});
  EXPECT_EQ(without_bounds(R"(, "min": [0, 0], "max": [0, 0, 0])"), Lines{})
      << "the length is reported";
  EXPECT_EQ(without_bounds(R"(, "min": [0, 0], "max": [0, 0, 0])", Profile::khronos),
            Lines{kAttributeAt + "POSITION"});
}

// --- Alignment ---

Lines of_layout(const std::string& accessors, const std::string& attributes,
                const std::string& stride, Profile profile = Profile::standard) {
  return selected(
      asset_with(R"("buffers": [{"byteLength": 200}], "bufferViews": [{"buffer": 0, "target": 34962,
      "byteLength": 200)" +
                 stride + R"(}], "accessors": [)" + accessors +
                 R"(], "meshes": [{"primitives": [{"attributes": {)" + attributes + "}}]}]"),
      {"MESH_PRIMITIVE_ACCESSOR_UNALIGNED", "MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE",
       "ACCESSOR_OFFSET_ALIGNMENT"},
      profile);
}

std::string bytes(int components, int offset) {
  return R"({"bufferView": 0, "count": 1, "componentType": 5121, "type": "VEC)" +
         std::to_string(components) + R"(", "byteOffset": )" + std::to_string(offset) + "}";
}

TEST(AttributeAlignment, AttributesLieOnMultiplesOfFourBytes) {
  const Lines found{"MESH_PRIMITIVE_ACCESSOR_UNALIGNED " + kAttributeAt + "_A"};
  EXPECT_EQ(of_layout(bytes(4, 0), R"("_A": 0)", ""), Lines{});
  EXPECT_EQ(of_layout(bytes(3, 0), R"("_A": 0)", ""), found);
  EXPECT_EQ(of_layout(bytes(3, 0), R"("_A": 0)", R"(, "byteStride": 4)"), Lines{});
  EXPECT_EQ(of_layout(bytes(4, 2), R"("_A": 0)", ""), found);
  EXPECT_EQ(of_layout(R"({"count": 3, "componentType": 5121, "type": "VEC3"})", R"("_A": 0)", ""),
            Lines{})
      << "compressed data has no layout yet";
}

TEST(AttributeAlignment, AnOffsetAtErrorIsSaidOnceButForTheKhronosProfile) {
  const std::string odd =
      R"({"bufferView": 0, "count": 1, "componentType": 5126, "type": "SCALAR", "byteOffset": 2})";
  EXPECT_EQ(of_layout(odd, R"("_A": 0)", ""),
            Lines{"ACCESSOR_OFFSET_ALIGNMENT /accessors/0/byteOffset"});
  EXPECT_EQ(of_layout(odd, R"("_A": 0)", "", Profile::khronos).size(), 2U);
}

TEST(AttributeAlignment, AttributesThatShareAViewNeedAStride) {
  const std::string three = bytes(4, 0) + "," + bytes(4, 4) + "," + bytes(4, 8);
  const std::string code = "MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE ";
  EXPECT_EQ(of_layout(three, R"("_A": 0, "_B": 1, "_C": 2)", R"(, "byteStride": 12)"), Lines{});
  EXPECT_EQ(of_layout(three, R"("_A": 0, "_B": 1, "_C": 2)", "", Profile::khronos),
            (Lines{code + kAttributeAt + "_B", code + kAttributeAt + "_C"}));
  EXPECT_EQ(of_layout(three, R"("_A": 0, "_B": 0)", ""), Lines{}) << "the same accessor twice";
}

}  // namespace
}  // namespace gltfx::test
