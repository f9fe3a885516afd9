// SPDX-License-Identifier: Apache-2.0
#include "json/keys.hpp"

#include <cstring>

#include <gmock/gmock.h>

#include "json/support.hpp"

namespace gltfx::json::testing {
namespace {

using ::testing::ElementsAre;

TEST(KeyTable, GivesTheSameNumberForTheSameName) {
  KeyTable table;
  EXPECT_EQ(table.find("a"), kNoKey);
  EXPECT_EQ(table.intern("a"), 0u);
  EXPECT_EQ(table.intern("b"), 1u);
  EXPECT_EQ(table.intern(""), 2u);
  EXPECT_EQ(table.intern_copy("a"), 0u);
  EXPECT_EQ(table.intern_copy("c"), 3u);
  EXPECT_EQ(table.intern("c"), 3u);
  EXPECT_EQ(table.find("b"), 1u);
  EXPECT_EQ(table.find("d"), kNoKey);
  EXPECT_EQ(table.size(), 4u);
  EXPECT_EQ(table.name(3), "c");
}

TEST(KeyTable, SaysWhetherANameIsNew) {
  KeyTable table;
  EXPECT_TRUE(table.insert("a"));
  EXPECT_FALSE(table.insert("a"));
  EXPECT_FALSE(table.insert_copy("a"));
  EXPECT_TRUE(table.insert_copy("b"));
  EXPECT_FALSE(table.insert("b"));
  EXPECT_TRUE(table.contains("b"));
  EXPECT_FALSE(table.contains("c"));
}

TEST(KeyTable, AStringIsTheSameWithAndWithoutEscapes) {
  const Document document = parse_clean(R"(["a\u0062", "ab", "", "\""])");
  KeyTable table;
  std::vector<bool> is_new;
  for (const NodeId element : document.elements(document.root()))
    is_new.push_back(document.insert_string(element, table));
  EXPECT_THAT(is_new, ElementsAre(true, false, true, true));
}

TEST(KeyTable, TellsNamesOfEveryLengthApart) {
  std::vector<std::string> names;
  for (std::size_t length = 0; length < 70; ++length) {
    for (std::size_t change = 0; change <= length; ++change) {
      names.emplace_back(length, 'a');
      if (change < length) names.back()[change] = 'b';
    }
  }
  KeyTable table;
  for (KeyId id = 0; id < names.size(); ++id) EXPECT_EQ(table.intern(names[id]), id);
  for (KeyId id = 0; id < names.size(); ++id) EXPECT_EQ(table.find(names[id]), id);
}

TEST(KeyTable, NamesThatAllCollideAreStillDifferent) {
  // With the first eight bytes of all names as seed the hash multiplies by zero.
  std::uint64_t seed = 0;
  std::memcpy(&seed, "prefix__", sizeof seed);
  KeyTable table(seed, 1);
  std::vector<std::string> names;
  for (int i = 0; i < 500; ++i) names.push_back(fmt::format("prefix__{:06}", i));
  for (KeyId id = 0; id < names.size(); ++id) EXPECT_EQ(table.intern(names[id]), id);
  for (KeyId id = 0; id < names.size(); ++id) EXPECT_EQ(table.find(names[id]), id);
}

TEST(Keys, ANameIsOneKeyHoweverItIsSpelt) {
  const Document document =
      parse_clean(R"([{"abc": 1}, {"\u0061bc": 2}, {"a\u0062c": 3}, {"abd": 4}])");
  EXPECT_EQ(document.key_count(), 2u);
  EXPECT_EQ(document.key(document.key_id("abc")), "abc");
  EXPECT_EQ(document.key_id("nothing"), kNoKey);
  std::vector<double> found;
  for (const NodeId object : document.elements(0)) {
    const NodeId value = document.find(object, "abc");
    if (value != kNoNode) found.push_back(document.number(value).value);
  }
  EXPECT_THAT(found, ElementsAre(1, 2, 3));
}

TEST(Keys, ANameWithEscapesIsNotMistakenForItsRawLookalike) {
  // The name a"b is followed by text that would match it without its backslash.
  const Document document = parse_clean(R"([{"a\"b": 1}, {"a": 2}, {"a\\": 3}, {"a": 4}])");
  std::vector<std::string> names;
  for (const NodeId object : document.elements(0)) {
    for (const Members::Member& member : document.members(object)) {
      names.emplace_back(document.key(member.key_id));
    }
  }
  EXPECT_THAT(names, ElementsAre("a\"b", "a", "a\\", "a"));
  EXPECT_EQ(errors_of(R"([{"a\"b": 1}, {"a"b": 2}])"),
            (std::vector<std::string>{"syntax 1:19-1:20"}));
}

TEST(Keys, ObjectsWithOtherMembersInOtherOrderAreReadRight) {
  const Document document = parse_clean(
      R"([{"a":1,"b":2,"c":3},{"a":1,"c":3},{"b":2,"a":1},{"ab":0,"a":1},{"a":1,"bb":0,"b":2}])");
  std::string order;
  for (const NodeId object : document.elements(0)) {
    for (const Members::Member& member : document.members(object)) {
      order.append(document.key(member.key_id)).append(document.raw(member.value));
      EXPECT_EQ(document.string(member.key), document.key(member.key_id));
    }
    order += ';';
  }
  EXPECT_EQ(order, "a1b2c3;a1c3;b2a1;ab0a1;a1bb0b2;");
}

TEST(DuplicateKeys, AMemberOfTheSameNameIsReportedWithTheOneBeforeIt) {
  const Parsed parsed = parse("{\"a\": 1, \"b\": 2,\n \"\\u0061\": 3, \"a\": 4}");
  ASSERT_EQ(parsed.errors.size(), 2u);
  EXPECT_EQ(parsed.errors[0].error, SyntaxError::duplicate_key);
  EXPECT_EQ(parsed.errors[0].span.in(parsed.document.text()), "\"\\u0061\"");
  EXPECT_EQ(parsed.errors[1].span.in(parsed.document.text()), "\"a\"");
  EXPECT_EQ(parsed.errors[0].other, (Span{1, 4}));
  EXPECT_EQ(parsed.errors[1].other, parsed.errors[0].span);
  EXPECT_EQ(parsed.document.number(parsed.document.find(0, "a")).value, 4);
}

TEST(DuplicateKeys, TheLastMemberIsInSight) {
  const Parsed parsed = parse(R"({"a":1,"b":{"x":[5]},"a":2,"b":3,"a":{"k":7}})");
  const Document& document = parsed.document;
  std::string seen;
  for (const auto member : document.members(document.root())) {
    seen.append(document.key(member.key_id)).append(document.raw(member.value)).append(" ");
  }
  EXPECT_EQ(seen, R"(b3 a{"k":7} )");
  EXPECT_EQ(document.object_size(document.root()), 2u);
  std::string pointers;
  for (NodeId node = 0; node < document.node_count(); ++node) {
    pointers.append(document.pointer_of(node)).append(" ");
  }
  EXPECT_EQ(pointers, " /a /a /b /b /b/x /b/x /a /a /b /b /a /a /a/k /a/k ");
}

TEST(DuplicateKeys, TheSameNameInOtherObjectsIsNoRepeat) {
  EXPECT_TRUE(parse(R"({"a": {"a": {"a": 1}, "b": 1}, "b": [{"a": 1}, {"a": 2}]})").ok());
  EXPECT_THAT(errors_of(R"({"a": {"a": 1}, "a": {"a": 1}})"),
              ElementsAre("duplicate_key 1:17-1:20"));
}

TEST(DuplicateKeys, AreFoundInObjectsOfAnySize) {
  std::string text = "{\"first\":0";
  for (int i = 0; i < 100000; ++i) text += fmt::format(",\"k{}\":{}", i, i);
  const std::size_t second = text.size() + 1;
  text += ",\"first\":1}";
  const Parsed parsed = parse(text);
  ASSERT_EQ(parsed.errors.size(), 1u);
  EXPECT_EQ(parsed.errors[0].span.begin, second);
  EXPECT_EQ(parsed.errors[0].other, (Span{1, 8}));
  EXPECT_EQ(parsed.document.key_count(), 100001u);
  EXPECT_EQ(parsed.document.number(parsed.document.find(0, "k99999")).value, 99999);
}

TEST(DuplicateKeys, AHundredThousandOfThemAreCounted) {
  std::string text = "{\"k\":0";
  for (int i = 0; i < 100000; ++i) text += ",\"k\":1";
  const Parsed parsed = parse(text + "}");
  EXPECT_EQ(parsed.errors.size() + parsed.unrecorded_errors, 100000u);
  EXPECT_EQ(parsed.errors.size(), Limits{}.recorded_errors);
  EXPECT_EQ(parsed.document.key_count(), 1u);
}

}  // namespace
}  // namespace gltfx::json::testing
