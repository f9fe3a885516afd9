// SPDX-License-Identifier: Apache-2.0
#include "schema/pattern.hpp"

#include <gtest/gtest.h>

namespace gltfx::schema {
namespace {

bool matches(std::string_view expression, std::string_view text) {
  const auto pattern = Pattern::compile(expression);
  EXPECT_TRUE(pattern) << expression;
  return pattern && pattern->matches(text);
}

struct Match {
  const char* expression;
  const char* text;
  bool expected;
};

class PatternMatches : public testing::TestWithParam<Match> {};

TEST_P(PatternMatches, AsEcmaDoes) {
  EXPECT_EQ(matches(GetParam().expression, GetParam().text), GetParam().expected)
      << GetParam().expression << " on " << GetParam().text;
}

INSTANTIATE_TEST_SUITE_P(
    Pattern, PatternMatches,
    testing::Values(
        Match{"", "", true}, Match{"", "x", true}, Match{"a", "bab", true},
        Match{"a", "bcb", false}, Match{"^a", "ba", false}, Match{"a$", "ab", false},
        Match{"^a$", "a", true}, Match{"^$", "", true}, Match{"^$", "a", false},
        Match{"^ab*c$", "ac", true}, Match{"^ab*c$", "abbbc", true}, Match{"^ab+c$", "ac", false},
        Match{"^ab?c$", "abbc", false}, Match{"^a{2}$", "aa", true}, Match{"^a{2}$", "aaa", false},
        Match{"^a{2,}$", "a", false}, Match{"^a{2,}$", "aaaa", true},
        Match{"^a{1,3}$", "aaa", true}, Match{"^a{1,3}$", "aaaa", false},
        Match{"^a{0,2}$", "", true}, Match{"^a{,2}$", "a{,2}", true},
        Match{"^(ab|cd)+$", "abcdab", true}, Match{"^(ab|cd)+$", "abc", false},
        Match{"^(?:a|)$", "", true}, Match{"a|b|c", "xcx", true}, Match{"^a|b$", "axx", true},
        Match{"^a|b$", "xbx", false}, Match{"^[a-c]$", "b", true}, Match{"^[a-c]$", "d", false},
        Match{"^[^a-c]$", "d", true}, Match{"^[^a-c]$", "b", false}, Match{"^[-a]$", "-", true},
        Match{"^[a-]$", "-", true}, Match{"^[]a]", "a", false}, Match{"^[\\]a]$", "]", true},
        Match{"^[\\d_]+$", "12_3", true}, Match{"^[\\D]$", "1", false},
        Match{"^\\d\\D\\w\\W\\s\\S$", "1a_- x", true}, Match{"^\\w+$", "a_9Z", true},
        Match{"^\\w$", "\xc3\xa4", false}, Match{"^[^\\s]+$", "a b", false},
        Match{"^.$", "\xc3\xa4", true}, Match{"^.$", "\n", false}, Match{"^\\.$", ".", true},
        Match{"^\\.$", "x", false}, Match{"^\\x41\\u0042$", "AB", true},
        Match{"^\\t\\n$", "\t\n", true}, Match{"^[\xc3\xa4-\xc3\xbc]$", "\xc3\xb6", true},
        Match{"^a*?b$", "aab", true}, Match{"^(a*)*$", "aaaa", true},
        Match{"^(a*)*$", "aaab", false}, Match{"^(|a)+$", "aa", true},
        Match{"^(0|[1-9][0-9]{0,8})\\.(0|[1-9][0-9]{0,8})$", "2.0", true},
        Match{"^(0|[1-9][0-9]{0,8})\\.(0|[1-9][0-9]{0,8})$", "2.01", false}));

class PatternRefuses : public testing::TestWithParam<const char*> {};

TEST_P(PatternRefuses, WhatItDoesNotUnderstand) {
  EXPECT_FALSE(Pattern::compile(GetParam())) << GetParam();
}

INSTANTIATE_TEST_SUITE_P(Pattern, PatternRefuses,
                         testing::Values("(", ")", "a)", "[", "[a", "*", "+a", "?", "a**", "^*",
                                         "(?=a)", "(?!a)", "(?<n>a)", "\\", "\\b", "\\1", "\\xg0",
                                         "\\u12", "[b-a]", "a{3,2}", "a{2000}", "(a{1000}){1000}"));

TEST(Pattern, DeepGroupsAreRefusedNotRecursedInto) {
  EXPECT_FALSE(Pattern::compile(std::string(100000, '(') + std::string(100000, ')')));
}

TEST(Pattern, HostileTextsAreMatchedInLinearTime) {
  // Backtracking would need 2^n steps, and recursion a frame a character.
  const std::string text(1000000, 'a');
  EXPECT_FALSE(matches("^(a|a)*b$", text));
  EXPECT_FALSE(matches("^(a+)+b$", text));
  EXPECT_TRUE(matches("^(a|b)*$", text));
}

TEST(Pattern, KeepsItsText) { EXPECT_EQ(Pattern::compile("^a$")->text(), "^a$"); }

}  // namespace
}  // namespace gltfx::schema
