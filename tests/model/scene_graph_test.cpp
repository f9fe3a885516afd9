// SPDX-License-Identifier: Apache-2.0
#include "model/scene_graph.hpp"

#include <gtest/gtest.h>

#include "asset_text.hpp"

namespace gltfx::model {
namespace {

using test::AssetText;

TEST(SceneGraph, LastParentCountsAndEarlierOnesAreKept) {
  const AssetText text(R"({"nodes": [{"children": [2]}, {"children": [2, 9, 3]}, {}, {}]})");
  const SceneGraph graph(text.asset, read_nodes(text.asset));
  EXPECT_EQ(graph.parent(2), 1U);
  EXPECT_EQ(graph.parent(3), 1U);
  EXPECT_TRUE(graph.is_root(0));
  ASSERT_EQ(graph.overrides().size(), 1U);
  EXPECT_EQ(graph.overrides()[0].child, 2U);
  EXPECT_EQ(graph.overrides()[0].previous, 0U);
  EXPECT_EQ(graph.overrides()[0].position, 0U);
  EXPECT_EQ(graph.overrides()[0].span.in(text.document.text()), "2");
}

TEST(SceneGraph, ComponentIsTheRootOrTheLoopAbove) {
  const AssetText text(R"({"nodes": [{"children": [1]}, {"children": [2]}, {},
    {"children": [4]}, {"children": [3, 5]}, {"children": [6]}, {}]})");
  const SceneGraph graph(text.asset, read_nodes(text.asset));
  EXPECT_EQ(graph.root(2), 0U);
  EXPECT_EQ(graph.root(0), 0U);
  EXPECT_EQ(graph.root(6), kNoNodeIndex);
  EXPECT_EQ(graph.component(6), graph.component(3));
  EXPECT_NE(graph.component(6), graph.component(2));
  EXPECT_TRUE(graph.on_loop(3));
  EXPECT_TRUE(graph.on_loop(4));
  EXPECT_FALSE(graph.on_loop(5));
}

TEST(Ancestry, KnowsWhoIsAbove) {
  const AssetText text(R"({"nodes": [{"children": [1, 2]}, {"children": [3]}, {}, {}, {},
    {"children": [5]}]})");
  const SceneGraph graph(text.asset, read_nodes(text.asset));
  const Ancestry ancestry(graph);
  const auto above = [&](NodeIndex a, NodeIndex b) { return ancestry.is_ancestor_or_self(a, b); };
  EXPECT_TRUE(above(0, 3));
  EXPECT_TRUE(above(1, 3));
  EXPECT_TRUE(above(3, 3));
  EXPECT_FALSE(above(3, 1));
  EXPECT_FALSE(above(2, 3));
  EXPECT_FALSE(above(1, 2));
  EXPECT_FALSE(above(4, 3));
  EXPECT_FALSE(above(5, 5));
}

TEST(Node, ReadsItsMembersAndItsTransform) {
  const AssetText text(R"({"meshes": [{}], "nodes": [{"mesh": 0, "camera": 3, "scale": [1, 2, 3],
    "rotation": [0, 0, 0, 2], "translation": [0, 0]}]})");
  const Node node = read_node(text.asset, text.asset.elements(RootArray::nodes)[0]);
  EXPECT_EQ(node.mesh, 0U);
  EXPECT_FALSE(node.camera);
  EXPECT_NE(node.camera_value, json::kNoNode);
  const Transform transform = read_transform(text.document, node);
  ASSERT_TRUE(transform.scale);
  EXPECT_EQ((*transform.scale)[2], 3.0F);
  EXPECT_FALSE(transform.rotation);
  EXPECT_FALSE(transform.translation);
  EXPECT_FALSE(transform.is_identity());
}

}  // namespace
}  // namespace gltfx::model
