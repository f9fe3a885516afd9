// SPDX-License-Identifier: Apache-2.0
/// The fuzzer's check on texts that are kept: the seeds, and a table of edge cases.
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "json/oracle.hpp"
#include "json/support.hpp"

namespace gltfx::json::testing {
namespace {

TEST(Oracle, AgreesOnEverySeedOfTheFuzzer) {
  std::size_t seeds = 0;
  const std::filesystem::path folder = GLTFX_SOURCE_DIR "/tests/fuzz/corpus/json";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(fuzz::check_json(text), "") << entry.path();
    ++seeds;
  }
  EXPECT_GT(seeds, 20u);
}

TEST(Oracle, AgreesOnEveryTruncationOfASample) {
  for (std::size_t size = 0; size <= kSample.size(); ++size) {
    EXPECT_EQ(fuzz::check_json(kSample.substr(0, size)), "") << kSample.substr(0, size);
  }
}

TEST(Oracle, AgreesOnEveryByteReplacedBySomethingOfTheGrammar) {
  for (const char replacement : std::string_view("\"\\{}[],:-+.0129eEutn \n\t\x01\x7f\x80\xff")) {
    for (std::size_t at = 0; at < kSample.size(); ++at) {
      std::string text(kSample);
      text[at] = replacement;
      ASSERT_EQ(fuzz::check_json(text), "") << text;
    }
  }
}

TEST(Oracle, AgreesOnEveryShortTextOfTheGrammar) {
  // All texts of up to four characters out of these: 11 + 121 + 1331 + 14641.
  constexpr std::string_view kAlphabet = "[]{},:\"1-0 ";
  std::vector<std::string> texts{""};
  for (std::size_t at = 0; at < texts.size(); ++at) {
    ASSERT_EQ(fuzz::check_json(texts[at]), "") << texts[at];
    if (texts[at].size() == 4) continue;
    for (const char c : kAlphabet) texts.push_back(texts[at] + c);
  }
}

class OracleCase : public ::testing::TestWithParam<std::string_view> {};

TEST_P(OracleCase, AgreesOnVerdictAndValues) { EXPECT_EQ(fuzz::check_json(GetParam()), ""); }

INSTANTIATE_TEST_SUITE_P(
    Edges, OracleCase,
    ::testing::Values("[]", "{}", "[[],[[]],{}]", "\"\"", "0", "-0", "-", "1", "1.0", "-1.5e-5",
                      "1e5", "1E5", "1e+5", "0.1e1", "0e0", "0e", "01", "1.", ".1", "+1", "--1",
                      "0x1", "1e1.5", "9007199254740993", "18446744073709551615",
                      "9223372036854775808", "-9223372036854775808", "0.1", "1e23",
                      "8.98846567431158e307", "5e-324", "2.4703282292062328e-324",
                      "123456789012345678901234567890", "true", "false", "null", "tru", "truex",
                      "True", "nul", "[true,false,null]", "\"\\u0000\"", "\"\\u00e9\\u20ac\"",
                      "\"\\ud83d\\ude00\"", "\"\\ud83d\"", "\"\\ude00\"", "\"\\ud83dx\"",
                      "\"\\ud83d\\n\"", "\"\\ud83d\\u0041\"", "\"\\uD83D\\uD83D\\uDE00\"",
                      "\"\\u12\"", "\"\\U0041\"", "\"\\x41\"", "\"\\\"", "\"\n\"", "\"\t\"",
                      "\"\x7f\"", "\"\u2028\"", "\"\xC0\x80\"", "\"\xF4\x90\x80\x80\"",
                      "\"\xEF\xBF\xBF\"", "{\"a\":1,\"a\":2}", "{\"\":{\"\":[]}}", "{\"a\"}",
                      "{\"a\":}", "{:1}", "{1:1}", "[1,]", "[,1]", "[1 2]", "[1,2", "1 2", "[1]]",
                      "{\"a\":1}}", " [1] ", "\f[1]", "\u00a0[1]", "\xEF\xBB\xBF[1]", "[1]\n",
                      "[\"a\",1,{\"b\":[2,3]}]", "[1,\"a\"]", "[1,null,2]", "[1,[2,[3,[4]]]]"));

}  // namespace
}  // namespace gltfx::json::testing
