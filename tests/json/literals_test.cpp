// SPDX-License-Identifier: Apache-2.0
#include "json/literals.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "json/support.hpp"

namespace gltfx::json::testing {
namespace {

TEST(NumberValue, BeyondTheRangeOfADoubleIsAnInfinityOrZero) {
  EXPECT_EQ(number_value("1e+400"), INFINITY);
  EXPECT_EQ(number_value("-1E400"), -INFINITY);
  EXPECT_EQ(number_value("0.001e+4000"), INFINITY);
  EXPECT_EQ(number_value("1" + std::string(400, '0')), INFINITY);
  EXPECT_EQ(number_value("1e99999999999999999999"), INFINITY);
  EXPECT_EQ(number_value("1e-99999999999999999999"), 0);
  EXPECT_EQ(number_value("1e-400"), 0);
  EXPECT_TRUE(std::signbit(number_value("-1e-400")));
}

TEST(NumberValue, DecimalsAreTheNearestDoubles) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200'000; ++i) {
    std::string digits = std::to_string(random() % 10'000'000'000'000'000'000U);
    digits.resize(std::min<std::size_t>(digits.size(), 1 + random() % 19));
    const std::size_t point = 1 + random() % digits.size();
    std::string literal = digits.substr(0, point);
    if (point < digits.size()) literal += "." + digits.substr(point);
    if (random() % 2 == 0) literal = "0." + digits;
    if (random() % 8 == 0) literal += "e-3";
    if (random() % 2 == 0) literal = "-" + literal;
    const double nearest = std::strtod(literal.c_str(), nullptr);
    EXPECT_EQ(number_value(literal), nearest) << literal;
    const LeadingNumber leading = read_leading_number(literal + ", 1]");
    EXPECT_EQ(leading.value, nearest) << literal;
    EXPECT_EQ(leading.size, literal.size()) << literal;
  }
  EXPECT_TRUE(std::signbit(number_value("-0")));
  EXPECT_TRUE(std::signbit(number_value("-0.000")));
}

TEST(NumberValue, AZeroIsOneWhateverItsExponent) {
  for (const char* const text : {"0e0", "0e400", "0.000e+99999999999999999999", "0e-400"}) {
    EXPECT_EQ(number_value(text), 0) << text;
  }
}

TEST(Unescape, WhatIsNoEscapeStays) {
  const auto unescaped = [](std::string_view content) {
    std::string out;
    append_unescaped(out, content);
    return out;
  };
  EXPECT_EQ(unescaped(R"(a\x\n)"), "a\\x\n");
  EXPECT_EQ(unescaped("a\\"), "a\\");
  EXPECT_EQ(unescaped(R"(\u12)"), R"(\u12)");
}

TEST(Parse, NoTextAtAllIsAnEmptyOne) {
  const Parsed parsed = parse(SharedText());
  ASSERT_EQ(parsed.errors.size(), 1U);
  EXPECT_EQ(parsed.errors[0].error, SyntaxError::unexpected_end);
}

}  // namespace
}  // namespace gltfx::json::testing
