// SPDX-License-Identifier: Apache-2.0
/// Errors after which the parser continues.
#include <cmath>

#include <gmock/gmock.h>

#include "json/support.hpp"

namespace gltfx::json::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Recovery, AByteOrderMarkIsPassed) {
  EXPECT_THAT(errors_of("\xEF\xBB\xBF{\"a\":1}"), ElementsAre("byte_order_mark 1:1-1:2"));
  EXPECT_EQ(parse("\xEF\xBB\xBF[1]").document.span(0), (Span{3, 6}));
}

TEST(Recovery, TrailingCommasAreReportedAndDropped) {
  EXPECT_THAT(errors_of("[true,]"), ElementsAre("trailing_comma 1:6-1:7"));
  EXPECT_THAT(errors_of("{\"a\":1 ,\n}"), ElementsAre("trailing_comma 1:8-1:9"));
  const Parsed numbers = parse("[1, 2, ]");
  ASSERT_EQ(numbers.errors.size(), 1u);
  EXPECT_EQ(numbers.errors[0].span, (Span{5, 6}));
  EXPECT_EQ(numbers.document.kind(0), Kind::number_array);
  EXPECT_THAT(numbers_of(numbers.document, 0), ElementsAre(1, 2));
  EXPECT_EQ(numbers.document.array_size(0), 2u);
}

TEST(Recovery, AMissingCommaBetweenMembersIsReportedAtTheNextName) {
  const Parsed parsed = parse("{\"a\": 1\n \"b\": {} \"c\" : 2}");
  EXPECT_EQ(parsed.document.object_size(0), 3u);
  EXPECT_EQ(parsed.document.number(parsed.document.find(0, "c")).value, 2);
  EXPECT_THAT(errors_of(parsed.document.text()),
              ElementsAre("missing_comma 2:2-2:5", "missing_comma 2:10-2:13"));
}

TEST(Recovery, AMissingCommaBetweenElementsIsReportedAtTheNextElement) {
  EXPECT_THAT(errors_of("[{} {}\n[] \"s\" true null false -1]"),
              ElementsAre("missing_comma 1:5-1:6", "missing_comma 2:1-2:2", "missing_comma 2:4-2:7",
                          "missing_comma 2:8-2:12", "missing_comma 2:13-2:17",
                          "missing_comma 2:18-2:23", "missing_comma 2:24-2:26"));
  EXPECT_EQ(parse("[{} {}\n[] \"s\" true null false -1]").document.array_size(0), 8u);
}

TEST(Recovery, NumbersWithoutCommasAreStillOneNode) {
  const Parsed parsed = parse("[1 -2\n3]");
  EXPECT_THAT(errors_of("[1 -2\n3]"),
              ElementsAre("missing_comma 1:4-1:6", "missing_comma 2:1-2:2"));
  EXPECT_EQ(parsed.document.kind(0), Kind::number_array);
  EXPECT_THAT(numbers_of(parsed.document, 0), ElementsAre(1, -2, 3));
  EXPECT_EQ(parsed.document.array_size(0), 3u);
  const Parsed mixed = parse("[1 -2 \"x\"]");
  EXPECT_EQ(mixed.errors.size(), 2u);
  EXPECT_EQ(mixed.document.array_size(0), 3u);
  EXPECT_EQ(mixed.document.number(2).value, -2);
}

TEST(Recovery, WhatCannotBeAMemberOrElementIsNotTakenForAMissingComma) {
  EXPECT_THAT(errors_of("{\"a\": \"b\" \"c\", \"d\": 1}"), ElementsAre("syntax 1:11-1:14"));
  EXPECT_THAT(errors_of("{\"a\": 1 {}}"), ElementsAre("syntax 1:9-1:10"));
  EXPECT_THAT(errors_of("{\"a\": 1 2}"), ElementsAre("syntax 1:9-1:10"));
  EXPECT_THAT(errors_of("[true nul]"), ElementsAre("syntax 1:7-1:10"));
  EXPECT_THAT(errors_of("[true trueish]"), ElementsAre("syntax 1:7-1:14"));
  EXPECT_THAT(errors_of("[true \"open\n]"), ElementsAre("syntax 1:7-1:12"));
  EXPECT_THAT(errors_of("[true :]"), ElementsAre("syntax 1:7-1:8"));
}

TEST(Recovery, HalfASurrogatePairBecomesTheReplacementCharacter) {
  EXPECT_THAT(errors_of(R"(["\uD800"])"), ElementsAre("lone_surrogate 1:3-1:9"));
  EXPECT_THAT(errors_of(R"(["\uDC00x"])"), ElementsAre("lone_surrogate 1:3-1:9"));
  EXPECT_THAT(errors_of(R"(["\uD800\uD83D\uDE00"])"), ElementsAre("lone_surrogate 1:3-1:9"));
  EXPECT_THAT(errors_of(R"(["\uDE00\uD83D"])"),
              ElementsAre("lone_surrogate 1:3-1:9", "lone_surrogate 1:9-1:15"));
  EXPECT_EQ(parse(R"(["a\uD800b"])").document.string(1), "a\uFFFDb");
  EXPECT_EQ(parse(R"(["\uD800\uD83D\uDE00"])").document.string(1), "\uFFFD\U0001F600");
  EXPECT_EQ(parse(R"(["\uDBFF\uDFFF"])").document.string(1), "\U0010FFFF");
  EXPECT_THAT(errors_of(R"(["\uD7FF\uE000"])"), IsEmpty());
}

TEST(Recovery, NumbersBeyondADoubleBecomeInfinities) {
  EXPECT_THAT(errors_of("[1, 1e400, -1e400]"),
              ElementsAre("number_out_of_range 1:5-1:10", "number_out_of_range 1:12-1:18"));
  const Parsed parsed = parse("[1e400, -1e400, 1.8e308, 1e-400, -1e-400]");
  const auto values = numbers_of(parsed.document, 0);
  ASSERT_EQ(values.size(), 5u);
  EXPECT_EQ(values[0], HUGE_VAL);
  EXPECT_EQ(values[1], -HUGE_VAL);
  EXPECT_EQ(values[2], HUGE_VAL);
  EXPECT_EQ(values[3], 0);
  EXPECT_TRUE(std::signbit(values[4]));
  EXPECT_EQ(parsed.errors.size(), 3u);
}

TEST(Recovery, OutOfRangeIsDecidedByTheValueNotByTheLookOfTheLiteral) {
  const std::string zeros(400, '0');
  EXPECT_THAT(errors_of("1" + zeros), ElementsAre("number_out_of_range 1:1-1:402"));
  EXPECT_THAT(errors_of("1" + zeros + "e-400"), IsEmpty());
  EXPECT_THAT(errors_of("0." + zeros + "1e401"), IsEmpty());
  EXPECT_THAT(errors_of("0." + zeros + "1e800"), ElementsAre("number_out_of_range 1:1-1:408"));
  EXPECT_THAT(errors_of("0e999999999999999999999"), IsEmpty());
  EXPECT_THAT(errors_of("1e99999999999999999999999"), ElementsAre("number_out_of_range 1:1-1:26"));
  EXPECT_THAT(errors_of("1e-99999999999999999999999"), IsEmpty());
  EXPECT_THAT(errors_of("1.7976931348623157e308"), IsEmpty());
}

TEST(Recovery, ANumberOutOfRangeInAMixedArrayIsReportedOnce) {
  EXPECT_THAT(errors_of("[1e400, \"x\"]"), ElementsAre("number_out_of_range 1:2-1:7"));
}

TEST(Recovery, ErrorsStandInTheOrderOfTheText) {
  EXPECT_THAT(
      errors_of("\xEF\xBB\xBF{\"a\": {\"b\": 1, \"b\": 2,}, \"a\": [1,], \"c\": \"\\ud800\" \"d\": "
                "1e999}"),
      ElementsAre("byte_order_mark 1:1-1:2", "duplicate_key 1:17-1:20", "trailing_comma 1:23-1:24",
                  "duplicate_key 1:27-1:30", "trailing_comma 1:34-1:35", "lone_surrogate 1:44-1:50",
                  "missing_comma 1:52-1:55", "number_out_of_range 1:57-1:62"));
}

TEST(Recovery, AllOfThemKeepTheDocumentAndAreMarkedRecoverable) {
  for (const std::string_view text :
       {"\xEF\xBB\xBF[]", "[true,]", "[1 2]", "{\"a\":1,\"a\":2}", "[\"\\udc00\"]", "1e999"}) {
    const Parsed parsed = parse(text);
    ASSERT_EQ(parsed.errors.size(), 1u) << text;
    EXPECT_TRUE(is_recoverable(parsed.errors[0].error)) << text;
    EXPECT_FALSE(parsed.errors[0].detail.empty()) << text;
    EXPECT_FALSE(parsed.document.empty()) << text;
    EXPECT_FALSE(parsed.ok());
  }
}

TEST(Recovery, WhatWasFoundBeforeAFatalErrorIsKept) {
  EXPECT_THAT(errors_of("[[1,], @]"), ElementsAre("trailing_comma 1:4-1:5", "syntax 1:8-1:9"));
}

TEST(Recovery, ErrorsBeyondTheLimitAreCounted) {
  Limits limits;
  limits.recorded_errors = 3;
  std::string text = "[";
  for (int i = 0; i < 10; ++i) text += "1 ";
  const Parsed parsed = parse(text + "]", limits);
  EXPECT_EQ(parsed.errors.size(), 3u);
  EXPECT_EQ(parsed.unrecorded_errors, 6u);
  EXPECT_EQ(parsed.document.array_size(0), 10u);
  const Parsed fatal = parse(text + "@]", limits);
  ASSERT_EQ(fatal.errors.size(), 4u);
  EXPECT_EQ(fatal.errors.back().error, SyntaxError::syntax);
}

}  // namespace
}  // namespace gltfx::json::testing
