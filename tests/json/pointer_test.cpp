// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "json/support.hpp"

namespace gltfx::json::testing {
namespace {

TEST(Pointer, EveryNodeIsFoundAgainByItsPointer) {
  const Document document = parse_clean(kSample);
  for (NodeId id = 0; id < document.node_count(); ++id) {
    const bool is_key = document.kind(id) == Kind::key;
    EXPECT_EQ(document.resolve(document.pointer_of(id)), is_key ? id + 1 : id);
  }
}

TEST(Pointer, IsWrittenAsRfc6901Asks) {
  const Document document = parse_clean(R"({"a/b": [{"m~n": {"": 1}}], "\u0078": "x"})");
  std::vector<std::string> pointers;
  for (NodeId id = 0; id < document.node_count(); ++id) {
    if (document.kind(id) != Kind::key) pointers.push_back(document.pointer_of(id));
  }
  EXPECT_THAT(pointers, ::testing::ElementsAre("", "/a~1b", "/a~1b/0", "/a~1b/0/m~0n",
                                               "/a~1b/0/m~0n/", "/x"));
  EXPECT_EQ(document.pointer_of(1), "/a~1b");
}

TEST(Pointer, AnElementOfANumberArrayIsGivenByItsIndex) {
  const Document document = parse_clean(R"({"m": [5, 6, 7]})");
  std::optional<std::uint64_t> element;
  EXPECT_EQ(document.resolve("/m/2", &element), document.find(0, "m"));
  EXPECT_EQ(element, 2u);
  EXPECT_EQ(document.resolve("/m", &element), document.find(0, "m"));
  EXPECT_EQ(element, std::nullopt);
  EXPECT_EQ(document.resolve("/m/3", &element), kNoNode);
  EXPECT_EQ(document.resolve("/m/1/0", &element), kNoNode);
  EXPECT_EQ(document.resolve("/m/x", &element), kNoNode);
  EXPECT_EQ(document.resolve("/m/0"), document.find(0, "m"));
}

TEST(Pointer, ResolvesToNothingWhereNothingIs) {
  const Document document = parse_clean(R"({"a": ["x", "y"], "0": 1})");
  for (const std::string_view pointer : {"/b", "/b/c", "/a/1x", "/a/2", "/a/-", "/a/01", "/a/+1",
                                         "/a/", "/a/0/0", "a", "/a~2", "/a/99999999999999999999"}) {
    EXPECT_EQ(document.resolve(pointer), kNoNode) << pointer;
  }
  EXPECT_EQ(document.string(document.resolve("/a/1")), "y");
  EXPECT_EQ(document.number(document.resolve("/0")).value, 1);
  EXPECT_EQ(Document().resolve(""), kNoNode);
}

TEST(Pointer, OfRepeatedNamesTheLastIsResolved) {
  const Parsed parsed = parse(R"({"a": 1, "a": 2})");
  EXPECT_EQ(parsed.document.number(parsed.document.resolve("/a")).value, 2);
}

}  // namespace
}  // namespace gltfx::json::testing
