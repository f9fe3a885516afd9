// SPDX-License-Identifier: Apache-2.0
#include "json/literals.hpp"

#include <cmath>
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
