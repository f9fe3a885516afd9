// SPDX-License-Identifier: Apache-2.0
#include "json/document.hpp"

#include <cmath>
#include <string>
#include <string_view>

#include <gmock/gmock.h>

#include "json/support.hpp"

namespace gltfx::json::testing {
namespace {

TEST(Document, FindsMembersByName) {
  const Document document = parse_clean(R"({"a": 1, "b": {"a": 2}, "c": [3]})");
  EXPECT_EQ(document.number(document.find(0, "a")).value, 1);
  const NodeId inner = document.find(0, "b");
  EXPECT_EQ(document.number(document.find(inner, "a")).value, 2);
  EXPECT_EQ(document.find(inner, "c"), kNoNode);
  EXPECT_EQ(document.find(0, "x"), kNoNode);
  EXPECT_EQ(document.find(document.find(0, "c"), "a"), kNoNode);
  EXPECT_EQ(document.find(kNoNode, "a"), kNoNode);
  EXPECT_EQ(document.find(0, kNoKey), kNoNode);
  EXPECT_EQ(document.find(kNoNode, document.key_id("a")), kNoNode);
  EXPECT_EQ(document.find(document.find(0, "c"), document.key_id("a")), kNoNode);
  EXPECT_EQ(document.find_in_text(kNoNode, "a"), kNoNode);
  EXPECT_EQ(document.find_in_text(document.find(0, "c"), "a"), kNoNode);
  EXPECT_FALSE(document.has_value(0, "x"));
}

// Large objects have a table of their members; names come again out of order.
std::string object_of(int members) {
  std::string text = R"({"in":{"k1":"another"},"end":)";
  std::string inner = "{";
  for (int i = 0; i < members; ++i) {
    if (i > 0) inner += ',';
    const int name = i % 3 == 2 ? (i * 7) % 200 : i;
    inner += "\"k" + std::to_string(name) + "\":[" + std::to_string(i) + ",{}]";
  }
  return text + inner + "}}";
}

TEST(Document, TheLastMemberOfANameIsFoundWhateverTheNumberOfMembers) {
  for (const int members : {0, 1, 15, 16, 17, 63, 64, 65, 200, 5000}) {
    Document document = parse(object_of(members)).document;
    const NodeId object = document.find(0, "end");
    const auto expected = [&document, object](std::string_view name) {
      NodeId found = kNoNode;
      for (const auto member : document.members(object)) {
        if (document.key(member.key_id) == name) found = member.value;
      }
      return found;
    };
    for (const char* const name : {"k0", "k1", "k2", "k14", "k63", "k199", "k4999", "in", "no"}) {
      EXPECT_EQ(document.find(object, name), expected(name)) << name << " of " << members;
      EXPECT_EQ(document.find(object, document.key_id(name)), expected(name));
      EXPECT_EQ(document.find_in_text(object, name), expected(name));
    }
    const NodeId first = document.find(object, "k0");
    if (first == kNoNode) continue;
    document.hide(first);
    EXPECT_EQ(document.find(object, "k0"), kNoNode);
    EXPECT_EQ(document.find_in_text(object, "k0"), first);
    document.strip(object);
    EXPECT_EQ(document.find(object, "k1"), kNoNode);
  }
}

TEST(Document, HiddenMembersAreFoundInTheTextOnly) {
  Document document = parse(R"({"a": 1, "b": {"a": 2}, "a": 3, "c": 4})").document;
  document.hide(document.find(0, "a"));
  EXPECT_EQ(document.find(0, "a"), kNoNode) << "the earlier one does not come back";
  EXPECT_EQ(document.find(0, document.key_id("a")), kNoNode);
  EXPECT_EQ(document.raw(document.find_in_text(0, "a")), "3");
  EXPECT_TRUE(document.holds(0, "a"));
  EXPECT_FALSE(document.holds(0, "x"));
  EXPECT_TRUE(document.has_value(0, "a"));
  EXPECT_TRUE(document.is_hidden(document.find_in_text(0, "a")));
  std::vector<std::string> left;
  for (const auto member : document.members(0)) left.emplace_back(document.raw(member.value));
  EXPECT_THAT(left, ::testing::ElementsAre(R"({"a": 2})", "4"));
  document.hide(document.find(0, "c"));
  EXPECT_EQ(document.object_size(0), 1u) << "nothing after the last one either";
}

TEST(Document, AHiddenNullIsNoValue) {
  Document document = parse_clean(R"({"a": null})");
  EXPECT_TRUE(document.has_value(0, "a"));
  document.hide(document.find(0, "a"));
  EXPECT_FALSE(document.has_value(0, "a"));
  EXPECT_TRUE(document.holds(0, "a"));
}

TEST(Document, StrippedValuesAreObjectsWithoutMembers) {
  Document document = parse_clean(R"({"a": [{"b": 1}], "c": {"d": 1}, "e": 2})");
  for (const char* const name : {"a", "c", "e"}) {
    const NodeId value = document.find(0, name);
    document.strip(value);
    EXPECT_TRUE(document.is_object(value)) << name;
    EXPECT_EQ(document.object_size(value), 0u) << name;
    EXPECT_EQ(document.find(value, "d"), kNoNode) << name;
    EXPECT_EQ(document.find(value, document.key_id("d")), kNoNode) << name;
    EXPECT_FALSE(document.holds(value, "d")) << name;
  }
  EXPECT_EQ(document.object_size(0), 3u) << "they stay in their place";
}

TEST(Document, CountsMembersAndElements) {
  const Document document = parse_clean(R"([{}, {"a": {"b": 1}, "c": 2}, [], [1], [[1, 2], "x"]])");
  std::vector<std::size_t> sizes;
  for (const NodeId id : document.elements(0)) {
    sizes.push_back(document.is_object(id) ? document.object_size(id) : document.array_size(id));
  }
  EXPECT_THAT(sizes, ::testing::ElementsAre(0, 2, 0, 1, 2));
}

TEST(Document, IteratesNothingInWhatIsNoContainerOfThatKind) {
  const Document document = parse_clean(R"([1, "x", {"a": 1}, [2, 3]])");
  for (NodeId id = 1; id < document.node_count(); ++id) {
    if (!document.is_object(id)) {
      EXPECT_EQ(document.object_size(id), 0u) << id;
    }
    if (document.kind(id) == Kind::key) continue;
    for (const NodeId element : document.elements(id)) ADD_FAILURE() << id << " has " << element;
  }
}

TEST(Document, TellsKindsApart) {
  const Document document = parse_clean(R"(["s", 1, true, false, null, [], [1], {}])");
  EXPECT_TRUE(document.is_string(1));
  EXPECT_TRUE(document.is_number(2));
  EXPECT_TRUE(document.is_boolean(3) && document.is_boolean(4));
  EXPECT_EQ(document.kind(5), Kind::null);
  EXPECT_TRUE(document.is_array(6) && document.is_array(7));
  EXPECT_TRUE(document.is_object(8));
  EXPECT_FALSE(document.is_boolean(1) || document.is_number(1) || document.is_array(8));
}

struct IntegerCase {
  std::string_view text;
  std::optional<std::uint64_t> value;
};

class UnsignedInteger : public ::testing::TestWithParam<IntegerCase> {};

TEST_P(UnsignedInteger, IsReadWhenTheFractionIsZeroAndTheValueExact) {
  const Document document = parse_clean(GetParam().text);
  EXPECT_EQ(document.unsigned_integer(0), GetParam().value) << GetParam().text;
}

INSTANTIATE_TEST_SUITE_P(
    Numbers, UnsignedInteger,
    ::testing::Values(IntegerCase{"0", 0}, IntegerCase{"-0", 0}, IntegerCase{"7", 7},
                      IntegerCase{"1.0", 1}, IntegerCase{"1e3", 1000}, IntegerCase{"12.5e1", 125},
                      IntegerCase{"4294967295", 4294967295},
                      IntegerCase{"999999999999999", 999999999999999},
                      IntegerCase{"1000000000000000", 1000000000000000},
                      IntegerCase{"9007199254740992", 9007199254740992},
                      IntegerCase{"9007199254740994", std::nullopt},
                      IntegerCase{"-1", std::nullopt}, IntegerCase{"1.5", std::nullopt},
                      IntegerCase{"1e-1", std::nullopt}, IntegerCase{"1e300", std::nullopt},
                      IntegerCase{"\"1\"", std::nullopt}, IntegerCase{"[1]", std::nullopt},
                      IntegerCase{"true", std::nullopt}));

TEST(Number, IsTheNearestDouble) {
  const auto value = [](std::string_view text) { return parse_clean(text).number(0).value; };
  EXPECT_EQ(value("0.1"), 0.1);
  EXPECT_EQ(value("123456789012345"), 123456789012345.0);
  EXPECT_EQ(value("9007199254740993"), 9007199254740992.0);
  EXPECT_EQ(value("18446744073709551616"), 18446744073709551616.0);
  EXPECT_EQ(value("2.2250738585072011e-308"), 2.2250738585072011e-308);
  EXPECT_EQ(value("4.9e-324"), 4.9e-324);
  EXPECT_EQ(value("2e-324"), 0);
  EXPECT_EQ(value("1.7976931348623157e308"), 1.7976931348623157e308);
  EXPECT_EQ(value("-1.5E+2"), -150);
  EXPECT_TRUE(std::signbit(value("-0")));
  EXPECT_TRUE(std::signbit(value("-0.0")));
}

TEST(Number, IsAnIntegerByValueNotBySpelling) {
  const auto is_integer = [](std::string_view text) {
    return parse(text).document.number(0).is_integer();
  };
  EXPECT_TRUE(is_integer("1.0"));
  EXPECT_TRUE(is_integer("-9007199254740992"));
  EXPECT_FALSE(is_integer("9007199254740994"));
  EXPECT_FALSE(is_integer("0.5"));
  EXPECT_FALSE(is_integer("1e999"));
}

}  // namespace
}  // namespace gltfx::json::testing
