// SPDX-License-Identifier: Apache-2.0
#include "json/equal.hpp"

#include <string>

#include <gtest/gtest.h>

#include "json/parse.hpp"

namespace gltfx::json {
namespace {

// In one document, and in two.
bool same(const std::string& one, const std::string& other) {
  const Parsed parsed = parse("[" + one + ", " + other + ", null]");
  const Document& document = parsed.document;
  auto element = document.elements(document.root()).begin();
  const NodeId first = *element;
  ++element;
  const bool here = equal(document, first, *element);
  const Parsed second = parse("[null, " + other + "]");
  auto there = second.document.elements(second.document.root()).begin();
  ++there;
  EXPECT_EQ(equal(document, first, second.document, *there), here) << one << " and " << other;
  return here;
}

TEST(Equal, ComparesWhatIsMeantAndNotHowItIsWritten) {
  EXPECT_TRUE(same("[1, 2.0]", "[1.0,2]"));
  EXPECT_TRUE(same(R"({"a": 1, "b": [true, {}]})", R"({"b":[true,{}],"\u0061":1e0})"));
  EXPECT_TRUE(same(R"("a")", R"("\u0061")"));
  EXPECT_TRUE(same("null", "null"));
}

TEST(Equal, FindsEveryDifference) {
  EXPECT_FALSE(same("[1, 2]", "[1, 3]"));
  EXPECT_FALSE(same("[1, 2]", "[1, 2, 3]"));
  EXPECT_FALSE(same("[1, 2, 3]", "[1, 2]"));
  EXPECT_FALSE(same("[1]", R"(["1"])"));
  EXPECT_FALSE(same(R"(["a"])", R"(["a", "b"])"));
  EXPECT_FALSE(same("true", "false"));
  EXPECT_FALSE(same("1", "2"));
  EXPECT_FALSE(same(R"("a")", R"("b")"));
  EXPECT_FALSE(same(R"({"a": 1})", R"({"b": 1})"));
  EXPECT_FALSE(same(R"({"a": 1})", R"({"a": 1, "b": 1})"));
  EXPECT_FALSE(same(R"({"a": 1, "b": 1})", R"({"a": 1, "x": 1, "y": 1})"));
  EXPECT_FALSE(same(R"({"a": {"b": [{"c": 1}]}})", R"({"a": {"b": [{"c": 2}]}})"));
}

TEST(Equal, TellsApartWhatADoubleOrAReaderDoesNot) {
  EXPECT_FALSE(same("9007199254740993", "9007199254740992"));
  EXPECT_FALSE(same("[1, 9007199254740993]", "[1, 9007199254740992]"));
  EXPECT_FALSE(same("0.1", "0.10000000000000000001"));
  EXPECT_FALSE(same("1e-400", "2e-400"));
  EXPECT_FALSE(same("-0.0", "0"));
  EXPECT_FALSE(same(R"("\ud800")", R"("\ud801")"));
  EXPECT_FALSE(same(R"("\ud800")", R"("\ufffd")"));
  EXPECT_FALSE(same(R"({"\ud800": 1})", R"({"\ud801": 1})"));
  EXPECT_TRUE(same("9007199254740993", "9007199254740993"));
  EXPECT_TRUE(same(R"("\ud800")", R"("\ud800")"));
  EXPECT_TRUE(same("1e400", "1e400"));
  EXPECT_TRUE(same("0", "0.0"));
}

TEST(Equal, DepthIsNoProblem) {
  const std::string deep = std::string(200, '[') + std::string(200, ']');
  EXPECT_TRUE(same(deep, deep));
  EXPECT_FALSE(same(deep, std::string(199, '[') + "0" + std::string(199, ']')));
}

}  // namespace
}  // namespace gltfx::json
