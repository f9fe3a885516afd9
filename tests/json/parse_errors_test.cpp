// SPDX-License-Identifier: Apache-2.0
/// Errors that end the parse: which, where, and in what words.
#include <gmock/gmock.h>

#include "json/support.hpp"

namespace gltfx::json::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Case {
  std::string_view text;
  std::string_view error;   ///< name and place
  std::string_view detail;  ///< part of the words
};

class Fatal : public ::testing::TestWithParam<Case> {};

TEST_P(Fatal, IsFoundWhereItStandsAndExplained) {
  const Case& expected = GetParam();
  EXPECT_THAT(errors_of(expected.text), ElementsAre(expected.error)) << expected.text;
  const Parsed parsed = parse(expected.text);
  ASSERT_EQ(parsed.errors.size(), 1u);
  EXPECT_THAT(parsed.errors[0].detail, HasSubstr(std::string(expected.detail)));
  EXPECT_FALSE(is_recoverable(parsed.errors[0].error));
  EXPECT_TRUE(parsed.document.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Syntax, Fatal,
    ::testing::Values(
        Case{"[1,,2]", "syntax 1:4-1:5", "expected a value, found ','"},
        Case{"[,1]", "syntax 1:2-1:3", "expected a value or ']', found ','"},
        Case{"[,]", "syntax 1:2-1:3", "found ','"},
        Case{"{,}", "syntax 1:2-1:3", "expected a member name in double quotes or '}', found ','"},
        Case{"{\"a\":1,,}", "syntax 1:8-1:9", "expected a member name in double quotes, found ','"},
        Case{"{\"a\" 1}", "syntax 1:6-1:7",
             "expected ':' after the member name, found the number '1'"},
        Case{"{\"a\":}", "syntax 1:6-1:7", "expected a value, found '}'"},
        Case{"{\"a\"}", "syntax 1:5-1:6", "expected ':'"},
        Case{"{\"a\"=1}", "syntax 1:5-1:6", "found '='"},
        Case{"{\"a\" b}", "syntax 1:6-1:7", "found the word 'b'"},
        Case{"{\"a\" \"b\r", "syntax 1:6-1:8", "found the string 'b'"},
        Case{"{\"a\" \"b\\", "syntax 1:6-1:9", "found the string 'b"},
        Case{"[1;2]", "syntax 1:3-1:4", "expected ',' or ']', found ';'"},
        Case{"[\"a\";2]", "syntax 1:5-1:6", "expected ',' or ']', found ';'"},
        Case{"{[1]:2}", "syntax 1:2-1:3", "member name"},
        Case{"{\"a\":[1,2}\n}", "syntax 1:10-1:11", "expected ',' or ']', found '}'"},
        Case{"[{\"a\":1]", "syntax 1:8-1:9", "expected ',' or '}', found ']'"},
        Case{"}", "syntax 1:1-1:2", "expected a JSON value, found '}'"},
        Case{"[\x01]", "syntax 1:2-1:3", "found the control character U+0001"},
        Case{"{\"a\": \"some \"quoted\" text\"}", "syntax 1:14-1:20",
             "write a quotation mark inside a string as \\\""},
        Case{"<html>", "syntax 1:1-1:2", "HTML"},
        Case{"\"materials\": [\n]", "syntax 1:1-1:12", "enclose the text in '{' and '}'"}));

INSTANTIATE_TEST_SUITE_P(
    End, Fatal,
    ::testing::Values(
        Case{"", "unexpected_end 1:1-1:1", "the text is empty"},
        Case{" \n ", "unexpected_end 2:2-2:2", "the text is empty"},
        Case{"{", "unexpected_end 1:2-1:2", "expected a member name in double quotes or '}'"},
        Case{"[", "unexpected_end 1:2-1:2", "expected a value or ']'"},
        Case{"[1", "unexpected_end 1:3-1:3", "expected ',' or ']', found the end of the text"},
        Case{"[1,", "unexpected_end 1:4-1:4", "expected a value"},
        Case{"[1,-", "unexpected_end 1:5-1:5", "inside the number '-'"},
        Case{"[1.", "unexpected_end 1:4-1:4", "inside the number '1.'"},
        Case{"[1e", "unexpected_end 1:4-1:4", "inside the number '1e'"},
        Case{"[1e+", "unexpected_end 1:5-1:5", "inside the number '1e+'"},
        Case{"[\"a\",\n", "unexpected_end 2:1-2:1", "expected a value"},
        Case{"{\"a\"", "unexpected_end 1:5-1:5", "expected ':'"},
        Case{"{\"a\":", "unexpected_end 1:6-1:6", "expected a value"},
        Case{"{\"a\":1", "unexpected_end 1:7-1:7", "expected ',' or '}'"},
        Case{"{\"a\":1,", "unexpected_end 1:8-1:8", "expected a member name"},
        Case{"[tru", "unexpected_end 1:5-1:5", "expected a value or ']'"},
        Case{"n", "unexpected_end 1:2-1:2", "expected a JSON value"},
        Case{"[{\"abc\":1},{\"a", "unexpected_end 1:15-1:15", "to close the string"},
        Case{"[\"abc", "unexpected_end 1:6-1:6", "expected '\"' to close the string"},
        Case{"[\"abc\\", "unexpected_end 1:7-1:7", "expected '\"' to close the string"},
        Case{"[\"\\u12", "unexpected_end 1:7-1:7", "expected '\"' to close the string"}));

INSTANTIATE_TEST_SUITE_P(
    Strings, Fatal,
    ::testing::Values(
        Case{"[\"a\x01\"]", "control_character 1:4-1:5",
             "found the control character U+0001 inside a string; write \\u0001"},
        Case{"[\"a\x01", "control_character 1:4-1:5", "write \\u0001"},
        Case{"[\"a\tb\"]", "control_character 1:4-1:5", "write \\u0009"},
        Case{"[\"abc\n]", "control_character 1:6-2:1", "is the closing '\"' missing?"},
        Case{std::string_view("[\"a\0b\"]", 7), "control_character 1:4-1:5", "found a NUL byte"},
        Case{R"(["\x41"])", "bad_escape 1:3-1:5", "found '\\x'"},
        Case{R"(["C:\temp\Data"])", "bad_escape 1:10-1:12", "write a backslash as \\\\"},
        Case{"[\"\\\u00e9\"]", "bad_escape 1:3-1:5", "found '\\\u00e9'"},
        Case{R"(["\u12G4"])", "bad_escape 1:3-1:7", "expected four hexadecimal digits after \\u"},
        Case{R"(["\u"])", "bad_escape 1:3-1:5", "four hexadecimal digits"},
        Case{R"({"\q":1})", "bad_escape 1:3-1:5", "found '\\q'"},
        Case{"[\"\xC3\"]", "invalid_utf8 1:3-1:4", "found '\\xc3'"},
        Case{"[1]\n\xE2\x82", "invalid_utf8 2:1-2:2", "the text must be UTF-8"},
        Case{"[\"\xED\xA0\x80\"]", "invalid_utf8 1:3-1:4", "found '\\xed\\xa0\\x80'"},
        Case{"[\"\xE2\x82\"]", "invalid_utf8 1:3-1:4", "found '\\xe2\\x82'"},
        Case{"[\"\xF0\x9F\x98\"]", "invalid_utf8 1:3-1:4", "found '\\xf0\\x9f\\x98'"},
        Case{"[\"\xC2\xC2\x80\"]", "invalid_utf8 1:3-1:4", "found '\\xc2'"},
        Case{"[\"\xC0\x80\"]", "invalid_utf8 1:3-1:4", "found '\\xc0\\x80'"},
        Case{"[\"\xF5\x80\x80\x80\"]", "invalid_utf8 1:3-1:4", "the text must be UTF-8"},
        Case{std::string_view("\xFF\xFE{\0}\0", 6), "invalid_utf8 1:1-1:2", "looks like UTF-16"},
        Case{std::string_view("\xFE\xFF\0{\0}", 6), "invalid_utf8 1:1-1:2", "looks like UTF-16"}));

INSTANTIATE_TEST_SUITE_P(
    Numbers, Fatal,
    ::testing::Values(
        Case{"[01]", "bad_number 1:2-1:4", "leading zeros are not allowed"},
        Case{"[-01]", "bad_number 1:2-1:5", "leading zeros are not allowed"},
        Case{"[00]", "bad_number 1:2-1:4", "leading zeros are not allowed"},
        Case{"[+1]", "bad_number 1:2-1:4", "a leading plus sign is not allowed"},
        Case{"[.5]", "bad_number 1:2-1:4", "found '.5'; expected a digit before the decimal point"},
        Case{"[-.5]", "bad_number 1:2-1:5", "expected a digit before"},
        Case{"[1.]", "bad_number 1:2-1:4", "expected a digit after the decimal point"},
        Case{"[1.e5]", "bad_number 1:2-1:6", "expected a digit after the decimal point"},
        Case{"[1e]", "bad_number 1:2-1:4", "in the exponent"},
        Case{"[1E-]", "bad_number 1:2-1:5", "in the exponent"},
        Case{"[-]", "bad_number 1:2-1:3", "expected a digit after the minus sign"},
        Case{"[--1]", "bad_number 1:2-1:5", "not a JSON number"},
        Case{"[0x10]", "bad_number 1:2-1:6", "hexadecimal"},
        Case{"[1.2.3]", "bad_number 1:2-1:7", "not a JSON number"},
        Case{"[1-2]", "bad_number 1:2-1:5", "not a JSON number"},
        Case{"[1_000]", "bad_number 1:2-1:7", "not a JSON number"},
        Case{"[12abc]", "bad_number 1:2-1:7", "not a JSON number"},
        Case{"{\"a\":\n NaN}", "bad_number 2:2-2:5", "NaN and infinity are not allowed"},
        Case{"[1, nan]", "bad_number 1:5-1:8", "NaN and infinity"},
        Case{"[inf]", "bad_number 1:2-1:5", "NaN and infinity"},
        Case{"[Infinity]", "bad_number 1:2-1:10", "NaN and infinity"},
        Case{"[-Infinity]", "bad_number 1:2-1:11", "NaN and infinity"},
        Case{"[-inf]", "bad_number 1:2-1:6", "NaN and infinity"}));

INSTANTIATE_TEST_SUITE_P(
    Literals, Fatal,
    ::testing::Values(
        Case{"[True]", "bad_literal 1:2-1:6", "found 'True'; in JSON it is lower case: true"},
        Case{"[FALSE]", "bad_literal 1:2-1:7", "lower case: false"},
        Case{"[NULL]", "bad_literal 1:2-1:6", "lower case: null"},
        Case{"[None]", "bad_literal 1:2-1:6", "write null"},
        Case{"[nil]", "bad_literal 1:2-1:5", "write null"},
        Case{"[undefined]", "bad_literal 1:2-1:11", "write null"},
        Case{"[truefalse]", "bad_literal 1:2-1:11", "found 'truefalse'"},
        Case{"[nul, 1]", "bad_literal 1:2-1:5", "found 'nul'"},
        Case{"[OPAQUE]", "bad_literal 1:2-1:8", "strings need double quotes"},
        Case{"{'a': 1}", "bad_literal 1:2-1:3", "double quotes"},
        Case{"{\"a\": 'b'}", "bad_literal 1:7-1:8", "double quotes"},
        Case{"[\u201Cb\u201D]", "bad_literal 1:2-1:3", "double quotes"},
        Case{"[\u201Db\u201D]", "bad_literal 1:2-1:3", "double quotes"},
        Case{"[\u201Eb\u201C]", "bad_literal 1:2-1:3", "double quotes"},
        Case{"[\u2018b\u2019]", "bad_literal 1:2-1:3", "double quotes"},
        Case{"[\u2019b\u2019]", "bad_literal 1:2-1:3", "double quotes"},
        Case{"[`b`]", "bad_literal 1:2-1:3", "double quotes"},
        Case{"// hi\n{}", "bad_literal 1:1-1:6", "comments are not allowed"},
        Case{"{\"a\": 1, // hi\n}", "bad_literal 1:10-1:15", "comments are not allowed"},
        Case{"[1 /* one\n */]", "bad_literal 1:4-2:4", "comments are not allowed"},
        Case{"[1 /*/", "bad_literal 1:4-1:7", "comments are not allowed"},
        Case{"[\n# hi\n]", "bad_literal 2:1-2:5", "comments are not allowed"},
        Case{"{}\n// bye", "bad_literal 2:1-2:7", "comments are not allowed"},
        Case{"{a: 1}", "bad_literal 1:2-1:3", "found 'a'; member names need double quotes"},
        Case{"{\"a\": 1, b: 2}", "bad_literal 1:10-1:11", "member names need double quotes"},
        Case{"{1: 2}", "bad_literal 1:2-1:3", "member names need double quotes"},
        Case{"materials: [", "bad_literal 1:1-1:10", "enclose the text in '{' and '}'"},
        Case{"glTF\x02", "bad_literal 1:1-1:5", "binary glTF"}));

INSTANTIATE_TEST_SUITE_P(
    Trailing, Fatal,
    ::testing::Values(Case{"{} {}", "trailing_data 1:4-1:5",
                           "expected the end of the text, found '{'"},
                      Case{"{}\n}", "trailing_data 2:1-2:2", "without an opening bracket"},
                      Case{"1 2", "trailing_data 1:3-1:4", "found the number '2'"},
                      Case{"[1],", "trailing_data 1:4-1:5", "found ','"},
                      Case{"1: 2", "trailing_data 1:2-1:3", "found ':'"},
                      Case{"{} \"x", "trailing_data 1:4-1:6", "found the string 'x'"},
                      Case{std::string_view("{}\0\0", 4), "trailing_data 1:3-1:4",
                           "pad the JSON chunk of a GLB with spaces"}));

TEST(FatalPlaces, AnUnclosedOrMismatchedBracketTellsWhereItWasOpened) {
  const auto other = [](std::string_view text) { return parse(text).errors.at(0).other; };
  EXPECT_EQ(other("[1, {\"a\": [2, 3"), (Span{10, 11}));
  EXPECT_EQ(other("[1, {\"a\": [2, -"), (Span{10, 11}));
  EXPECT_EQ(other("[[1, 2}"), (Span{1, 2}));
  EXPECT_EQ(other("{\"a\": [[], [1]}"), (Span{6, 7}));
  EXPECT_EQ(other("{\"a\": [[], []], \"b\": tru"), (Span{0, 1}));
  EXPECT_EQ(other("[1, \"abc"), (Span{4, 5}));
  EXPECT_EQ(other("[1, \"abc\n]"), (Span{4, 5}));
  EXPECT_TRUE(other("[1, 2, @]").empty());
  EXPECT_TRUE(other("tru").empty());
}

TEST(FatalPlaces, TextOfTheAssetIsNeutralisedInTheWords) {
  for (const std::string_view text : {"[\x1b]", "{\"a\" \u202e}", "[\"\\\x1b\"]"}) {
    const std::string detail = parse(text).errors.at(0).detail;
    EXPECT_EQ(detail.find('\x1b'), std::string::npos) << text;
    EXPECT_EQ(detail.find("\u202e"), std::string::npos) << text;
  }
}

TEST(FatalPlaces, LongTokensAreCutInTheWords) {
  const std::string word(100000, 'x');
  EXPECT_LT(parse("[" + word + "]").errors.at(0).detail.size(), 200u);
  EXPECT_LT(parse("{} \"" + word).errors.at(0).detail.size(), 200u);
}

}  // namespace
}  // namespace gltfx::json::testing
