// SPDX-License-Identifier: Apache-2.0
#include "graph/tree.hpp"

#include <gtest/gtest.h>

#include "json/parse.hpp"

namespace gltfx::graph {
namespace {

const json::Parsed& parsed() {
  static const json::Parsed made = json::parse(
      std::string_view(R"({"nodes":[{"name":"a"},{"children":[0,7,2]}],"a/b":{"c":1},"x":{}})"));
  return made;
}

TEST(Tree, APointerLeadsToAPlaceAndBack) {
  const Tree tree(parsed().document);
  for (const char* const pointer :
       {"", "/nodes", "/nodes/0/name", "/nodes/1/children", "/nodes/1/children/2", "/a~1b/c"}) {
    const Place place = tree.find(pointer);
    ASSERT_NE(place.node, json::kNoNode) << pointer;
    EXPECT_EQ(tree.pointer(place), pointer);
  }
  for (const char* const pointer : {"nodes", "/nodes/2", "/nodes/01", "/nodes/1/children/3",
                                    "/nodes/1/children/0/x", "/nodes/0/x", "/a/b"}) {
    EXPECT_EQ(tree.find(pointer).node, json::kNoNode) << pointer;
  }
}

TEST(Tree, ElementsHaveAPositionAndMembersAName) {
  const json::Document& document = parsed().document;
  const Tree tree(document);
  const json::NodeId node = tree.find("/nodes/1").node;
  EXPECT_EQ(tree.position(node), 1U);
  EXPECT_FALSE(tree.is_member(node));
  const json::NodeId children = tree.member(node, "children");
  EXPECT_TRUE(tree.is_member(children));
  EXPECT_EQ(tree.name(children), "children");
  EXPECT_EQ(tree.parent(children), node);
  EXPECT_EQ(tree.size(children), 3U);
  EXPECT_EQ(tree.size(document.root()), 3U);
  const auto place = static_cast<std::uint32_t>(document.text().find('7'));
  EXPECT_EQ(tree.number_at(children, place), 1U);
}

}  // namespace
}  // namespace gltfx::graph
