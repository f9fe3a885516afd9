// SPDX-License-Identifier: Apache-2.0
// Where nodes are: transforms, scenes, visibility, animated nodes, very many of them.
#include "model/pose.hpp"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/asset_text.hpp"
#include "model/bytes_asset.hpp"
#include "model/instancing.hpp"
#include "model/packed_bytes.hpp"

namespace gltfx::model {
namespace {

using test::AssetText;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

testing::Matcher<Vector3> near(double x, double y, double z) {
  return ElementsAre(DoubleNear(x, 1e-6), DoubleNear(y, 1e-6), DoubleNear(z, 1e-6));
}

struct Posed {
  explicit Posed(const std::string& text, const AnimatedValues& animated = {},
                 std::optional<std::uint32_t> scene = {})
      : file(text),
        views(file.asset),
        roots(choose_scene(file.asset, views, scene)),
        pose(compute_pose(file.asset, views, roots, animated)) {}

  Vector3 at(std::size_t node, const Vector3& point) const { return pose.world[node].point(point); }

  AssetText file;
  Views views;
  SceneRoots roots;
  Pose pose;
};

TEST(Affine, PartsAreAppliedInTheirOrder) {
  const double half = std::sqrt(0.5);
  const Affine turn = Affine::from_parts({1, 2, 3}, {0, 0, half, half}, {2, 3, 4});
  EXPECT_THAT(turn.point({1, 0, 0}), near(1, 4, 3));
  EXPECT_THAT(turn.point({0, 1, 0}), near(-2, 2, 3));
  EXPECT_THAT(turn.vector({0, 0, 1}), near(0, 0, 4));
  EXPECT_NEAR(turn.determinant(), 24, 1e-9);
  // Twice as long a quaternion is the same rotation; none at all turns nothing.
  EXPECT_THAT(Affine::from_parts({}, {0, 0, 3, 3}, {1, 1, 1}).point({1, 0, 0}), near(0, 1, 0));
  EXPECT_THAT(Affine::from_parts({}, {0, 0, 0, 0}, {1, 1, 1}).point({1, 0, 0}), near(1, 0, 0));
}

TEST(Affine, RotationsMeetHalfWay) {
  const Quaternion none{0, 0, 0, 1};
  const Quaternion half_turn{1, 0, 0, 0};
  const double half = std::sqrt(0.5);
  const Quaternion middle = slerp(none, half_turn, 0.5);
  EXPECT_NEAR(middle[0], half, 1e-12);
  EXPECT_NEAR(middle[3], half, 1e-12);
  EXPECT_EQ(slerp(none, {0, 0, 0, -2}, 0.3), none);
  const Quaternion near_none{1e-6, 0, 0, 1};
  EXPECT_NEAR(slerp(none, near_none, 0.5)[0], 5e-7, 1e-12);
}

TEST(Pose, ChildrenMoveWithTheirParents) {
  const Posed posed(R"({"scene": 0, "scenes": [{"nodes": [1]}], "nodes": [
 {"translation": [0, 1, 0], "children": [2]},
 {"scale": [2, 2, 2], "children": [0]},
 {"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1]}]})");
  EXPECT_THAT(posed.at(1, {1, 1, 1}), near(2, 2, 2));
  EXPECT_THAT(posed.at(0, {1, 1, 1}), near(2, 4, 2));
  EXPECT_THAT(posed.at(2, {0, 0, 0}), near(10, 14, 14));
  EXPECT_THAT(posed.pose.in_scene, ElementsAre(1, 1, 1));
}

TEST(Pose, AnimatedNodesTakeTheirPlace) {
  const AnimatedValues animated{{"/nodes/0/translation", {1, 0, 0}},
                                {"/nodes/1/rotation", {0, 0, 1, 0}},
                                {"/nodes/10/scale", {9, 9, 9}},
                                {"/nodes/2/scale", {3, 3}}};
  const Posed posed(R"({"scenes": [{"nodes": [0, 1, 2]}], "nodes": [
 {"translation": [0, 7, 0], "scale": [2, 2, 2]}, {}, {"scale": [2, 1, 1]}]})",
                    animated);
  EXPECT_THAT(posed.at(0, {1, 1, 1}), near(3, 2, 2));
  EXPECT_THAT(posed.at(1, {1, 0, 0}), near(-1, 0, 0));
  EXPECT_THAT(posed.at(2, {1, 1, 1}), near(2, 1, 1)) << "two numbers are no scale";
}

TEST(Pose, HiddenNodesHideWhatIsBelow) {
  const std::string text = R"({"scenes": [{"nodes": [0]}], "nodes": [
 {"children": [1, 2]},
 {"children": [3], "extensions": {"KHR_node_visibility": {"visible": false}}},
 {"extensions": {"KHR_node_visibility": {}}},
 {"extensions": {"KHR_node_visibility": {"visible": true}}},
 {}]})";
  EXPECT_THAT(Posed(text).pose.visible, ElementsAre(1, 0, 1, 0, 0));
  EXPECT_THAT(Posed(text).pose.in_scene, ElementsAre(1, 1, 1, 1, 0));
  const AnimatedValues shown{{"/nodes/1/extensions/KHR_node_visibility/visible", {1}},
                             {"/nodes/2/extensions/KHR_node_visibility/visible", {0}}};
  EXPECT_THAT(Posed(text, shown).pose.visible, ElementsAre(1, 1, 0, 1, 0));
}

TEST(Pose, TheSceneIsTheOneAskedForTheDefaultOrTheFirst) {
  const std::string scenes = R"("scenes": [{"nodes": [0]}, {"nodes": [1]}], "nodes": [{}, {}, {}])";
  const Posed first("{" + scenes + "}");
  EXPECT_THAT(first.roots.nodes, ElementsAre(0));
  EXPECT_THAT(first.roots.note, HasSubstr("first"));
  const Posed chosen(R"({"scene": 1, )" + scenes + "}");
  EXPECT_THAT(chosen.roots.nodes, ElementsAre(1));
  EXPECT_THAT(chosen.roots.note, IsEmpty());
  EXPECT_THAT(Posed(R"({"scene": 1, )" + scenes + "}", {}, 0).roots.nodes, ElementsAre(0));
  const Posed none(R"({"nodes": [{"children": [2]}, {}, {}]})");
  EXPECT_THAT(none.roots.nodes, ElementsAre(0, 1));
  EXPECT_THAT(none.roots.note, HasSubstr("no scene"));
  EXPECT_THAT(Posed(R"({})").roots.nodes, IsEmpty());
  EXPECT_THAT(Posed(R"({"scenes": [{}]})").roots.note, IsEmpty());
}

TEST(Pose, NodesOutsideTheSceneAreOnlyPlaced) {
  const Posed posed(R"({"scenes": [{"nodes": [0]}], "nodes": [
 {}, {"translation": [1, 0, 0], "children": [2]}, {"translation": [1, 0, 0]}]})");
  EXPECT_THAT(posed.at(2, {0, 0, 0}), near(2, 0, 0));
  EXPECT_THAT(posed.pose.in_scene, ElementsAre(1, 0, 0));
  EXPECT_THAT(posed.pose.visible, ElementsAre(1, 0, 0));
}

TEST(Pose, LoopsEnd) {
  const Posed posed(R"({"scenes": [{"nodes": [0]}], "nodes": [
 {"children": [1, 1]}, {"children": [0, 2]}, {"children": [2]}, {"children": [3]}]})");
  EXPECT_THAT(posed.pose.in_scene, ElementsAre(1, 1, 1, 0));
}

TEST(Pose, ChainsOfParentsMayBeVeryLong) {
  constexpr int kNodes = 200000;
  std::string text = R"({"scenes": [{"nodes": [0]}], "nodes": [)";
  for (int i = 1; i < kNodes; ++i) {
    text += R"({"translation": [0.5, 0, 0], "children": [)" + std::to_string(i) + "]}, ";
  }
  const Posed posed(text + "{}]}");
  EXPECT_THAT(posed.at(kNodes - 1, {0, 0, 0}), near((kNodes - 1) / 2.0, 0, 0));
}

TEST(Weights, ThoseOfTheNodeComeBeforeThoseOfTheMesh) {
  const std::string targets =
      R"("primitives": [{"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}, {"POSITION": 0}]}])";
  const AssetText file(R"({"accessors": [{}], "meshes": [{)" + targets +
                       R"(, "weights": [0.25, 0.5]}, {)" + targets +
                       R"(}], "nodes": [{"mesh": 0}, {"mesh": 0, "weights": [1, 0]},
 {"mesh": 1}, {"mesh": 0, "weights": [1, 2, 3]}, {}]})");
  const Views views(file.asset);
  const auto weights = [&](NodeIndex node, const AnimatedValues& animated = {}) {
    return morph_weights(file.asset, views, node, animated);
  };
  EXPECT_THAT(weights(0), ElementsAre(0.25F, 0.5F));
  EXPECT_THAT(weights(1), ElementsAre(1, 0));
  EXPECT_THAT(weights(2), ElementsAre(0, 0));
  EXPECT_THAT(weights(3), ElementsAre(0.25F, 0.5F)) << "three are too many";
  EXPECT_THAT(weights(4), IsEmpty());
  EXPECT_THAT(weights(0, {{"/meshes/0/weights/1", {9}}}), ElementsAre(0.25F, 9));
  EXPECT_THAT(weights(0, {{"/nodes/0/weights/0", {9}}}), ElementsAre(9, 0.5F));
  EXPECT_THAT(weights(1, {{"/meshes/0/weights", {7, 7}}}), ElementsAre(1, 0));
}

TEST(Instancing, EveryCopyHasItsTransform) {
  test::Accessors accessors;
  accessors.add("VEC3", 5126, 2, test::floats({1, 0, 0, 0, 2, 0}));
  accessors.add("VEC4", 5120, 2, test::packed<std::int8_t>({0, 0, 0, 127, 0, 0, 127, 0}),
                R"(, "normalized": true)");
  accessors.add("VEC3", 5126, 1, test::floats({1, 1, 1}));
  const test::BytesAsset asset(accessors, R"("nodes": [
 {"extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0, "ROTATION": 1, "_ID": 2}}}},
 {"extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0, "SCALE": 2}}}},
 {"extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"ROTATION": 0}}}}, {}])");
  const auto read = [&](std::size_t node, std::uint64_t bytes = 1000) {
    MemoryBudget budget(bytes);
    return read_instancing(asset.asset(), asset.views(), asset.resources(),
                           asset.views().nodes[node], budget);
  };
  const auto copies = read(0);
  ASSERT_TRUE(copies && copies->readable);
  ASSERT_EQ(copies->transforms.size(), 2U);
  EXPECT_THAT(copies->transforms[0].point({1, 1, 1}), near(2, 1, 1));
  EXPECT_THAT(copies->transforms[1].point({1, 1, 1}), near(-1, 1, 1));
  EXPECT_FALSE(read(1)->readable) << "lists of different length";
  EXPECT_FALSE(read(2)->readable) << "three numbers are no rotation";
  EXPECT_FALSE(read(1)->too_large);
  EXPECT_FALSE(read(0, sizeof(Affine))->readable) << "beyond the budget";
  EXPECT_TRUE(read(0, sizeof(Affine))->too_large);
  EXPECT_FALSE(read(3).has_value());
  const auto count = [&](std::size_t node) {
    return count_copies(asset.asset(), asset.views(), asset.resources(), asset.views().nodes[node]);
  };
  EXPECT_EQ(count(0), 2U);
  EXPECT_EQ(count(1), std::nullopt);
  EXPECT_EQ(count(3), 1U);
}

}  // namespace
}  // namespace gltfx::model
