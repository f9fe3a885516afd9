// SPDX-License-Identifier: Apache-2.0
/// Hostile sizes and every truncation.
#include <gmock/gmock.h>

#include "json/support.hpp"

namespace gltfx::json::testing {
namespace {

using ::testing::ElementsAre;

std::string repeat(std::string_view text, std::size_t times) {
  std::string all;
  all.reserve(text.size() * times);
  for (std::size_t i = 0; i < times; ++i) all += text;
  return all;
}

TEST(ParseLimits, DepthIsAllowedUpToTheLimitAndNoFurther) {
  Limits limits;
  limits.depth = 3;
  EXPECT_TRUE(parse("[[[]]]", limits).ok());
  EXPECT_TRUE(parse("[[[1]]]", limits).ok());
  EXPECT_TRUE(parse(R"({"a":[{"b":1}]})", limits).ok());
  EXPECT_THAT(errors_of("[[[[]]]]", limits), ElementsAre("too_deep 1:4-1:5"));
  EXPECT_THAT(errors_of("[[[[1]]]]", limits), ElementsAre("too_deep 1:4-1:5"));
  EXPECT_THAT(errors_of("[[[1,{}]]]", limits), ElementsAre("too_deep 1:6-1:7"));
  EXPECT_THAT(errors_of(R"({"a":[{"b":{}}]})", limits), ElementsAre("too_deep 1:12-1:13"));
}

TEST(ParseLimits, SiblingsDoNotAddToTheDepth) {
  Limits limits;
  limits.depth = 2;
  EXPECT_TRUE(parse(fmt::format("[{}{{}}]", repeat("[],", 1000)), limits).ok());
}

TEST(ParseLimits, AHundredThousandBracketsFailAtTheLimit) {
  const Parsed parsed = parse(repeat("[", 100000));
  ASSERT_EQ(parsed.errors.size(), 1u);
  EXPECT_EQ(parsed.errors[0].error, SyntaxError::too_deep);
  EXPECT_EQ(parsed.errors[0].span, (Span{1024, 1025}));
}

TEST(ParseLimits, AMillionLevelsAreReadWhenTheyAreAllowed) {
  constexpr std::size_t kLevels = 1000000;
  Limits limits;
  limits.depth = kLevels;
  const Parsed parsed = parse(repeat("[", kLevels) + repeat("]", kLevels), limits);
  EXPECT_TRUE(parsed.ok());
  EXPECT_EQ(parsed.document.node_count(), kLevels);
  EXPECT_EQ(parsed.document.pointer_of(kLevels - 1).size(), 2 * (kLevels - 1));
  EXPECT_EQ(parse(repeat("{\"a\":", kLevels), limits).errors.at(0).error,
            SyntaxError::unexpected_end);
}

TEST(ParseLimits, TheLengthOfTheTextIsLimited) {
  Limits limits;
  limits.bytes = 4;
  EXPECT_TRUE(parse("[12]", limits).ok());
  const Parsed parsed = parse("[123]", limits);
  ASSERT_EQ(parsed.errors.size(), 1u);
  EXPECT_EQ(parsed.errors[0].error, SyntaxError::too_large);
  EXPECT_EQ(parsed.errors[0].span, (Span{3, 4}));
  EXPECT_TRUE(parsed.document.empty());
}

TEST(ParseLimits, WideAndDenseTextsHaveAllTheirNodes) {
  constexpr std::size_t kTimes = 200000;
  EXPECT_EQ(parse_clean(fmt::format("[{}[]]", repeat("[],", kTimes))).array_size(0), kTimes + 1);
  EXPECT_EQ(parse_clean(fmt::format("[\"\"{}]", repeat(",0", kTimes))).array_size(0), kTimes + 1);
  EXPECT_EQ(parse_clean(fmt::format("[1{}]", repeat(",2", kTimes))).array_size(0), kTimes + 1);
  const Document late =
      parse_clean(fmt::format("[\"{}\"{}]", repeat("x", 5 * kTimes), repeat(",[]", kTimes)));
  EXPECT_EQ(late.array_size(0), kTimes + 1);
}

TEST(ParseLimits, EveryTruncationEndsTooEarlyAtItsEnd) {
  ASSERT_TRUE(parse(kSample).ok());
  for (std::size_t size = 0; size < kSample.size(); ++size) {
    const std::string_view cut = kSample.substr(0, size);
    const Parsed parsed = parse(cut);
    ASSERT_FALSE(parsed.ok()) << cut;
    // A cut inside a surrogate pair leaves a lone surrogate besides.
    ASSERT_LE(parsed.errors.size(), 2u) << cut;
    const ParseError& error = parsed.errors.back();
    // A cut inside a character of several bytes shows as such.
    if (error.error == SyntaxError::invalid_utf8) {
      EXPECT_EQ(error.span.end, size) << cut;
      continue;
    }
    EXPECT_EQ(error.error, SyntaxError::unexpected_end) << cut;
    EXPECT_EQ(error.span,
              (Span{static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(size)}));
    EXPECT_EQ(error.other.empty(), size == 0) << cut;
  }
}

TEST(ParseLimits, EveryByteReplacedByEveryOtherIsSurvived) {
  for (std::size_t at = 0; at < kSample.size(); ++at) {
    for (int byte = 0; byte < 256; ++byte) {
      std::string text(kSample);
      text[at] = static_cast<char>(byte);
      const Parsed parsed = parse(text);
      for (const ParseError& error : parsed.errors) {
        ASSERT_LE(error.span.begin, error.span.end);
        ASSERT_LE(error.span.end, text.size());
        ASSERT_TRUE(!error.span.empty() || error.span.end == text.size());
        ASSERT_LE(error.other.end, text.size());
      }
    }
  }
}

}  // namespace
}  // namespace gltfx::json::testing
