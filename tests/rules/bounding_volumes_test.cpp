// SPDX-License-Identifier: Apache-2.0
// glTF 2.1: whether bounding volumes enclose what they claim.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "model/packed_bytes.hpp"
#include "rules/selected.hpp"
#include "support/asset_builder.hpp"

namespace gltfx::test {
namespace {

const std::string kSmall = "BOUNDING_VOLUME_TOO_SMALL";
const std::string kPoses = "BOUNDING_VOLUME_MISSES_POSES";

/// A tetrahedron around the origin from -1 to 1; mesh 0.
struct Bounded : AssetBuilder {
  Bounded() {
    json["asset"]["version"] = "2.1";
    json["scene"] = 0;
    json["scenes"] = AssetBuilder::Json::array({{{"nodes", {0}}}});
    accessor("VEC3", 5126, 4, floats({1, 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1}),
             {{"min", {-1, -1, -1}}, {"max", {1, 1, 1}}});
    accessor("SCALAR", 5123, 12, packed<std::uint16_t>({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}));
    add("meshes", {{"primitives", AssetBuilder::Json::array(
                                      {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}})}});
  }

  std::size_t node(const std::string& members) { return add("nodes", members_of(members)); }
  void box(double x, double y, double z) {
    add("shapes", {{"type", "box"}, {"box", {{"size", {x, y, z}}}}});
  }
  void sphere(double radius) {
    add("shapes", {{"type", "sphere"}, {"sphere", {{"radius", radius}}}});
  }
  // An animation of one channel.
  void animate(int node, const std::string& path, const std::vector<float>& times,
               const std::vector<float>& values, const std::string& kind = "LINEAR") {
    const std::size_t input = accessor("SCALAR", 5126, times.size(), packed(times),
                                       {{"min", {times.front()}}, {"max", {times.back()}}});
    const std::size_t width = path == "rotation" ? 4 : path == "weights" ? 1 : 3;
    const char* const type = width == 4 ? "VEC4" : width == 3 ? "VEC3" : "SCALAR";
    const std::size_t output = accessor(type, 5126, values.size() / width, packed(values));
    AssetBuilder::Json sampler{{"input", input}, {"output", output}, {"interpolation", kind}};
    AssetBuilder::Json channel{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}};
    add("animations", {{"samplers", AssetBuilder::Json::array({sampler})},
                       {"channels", AssetBuilder::Json::array({channel})}});
  }
  Lines found() const { return selected(text(buffer_uri(bytes)), {kSmall, kPoses}); }
  // What the message says of the distance; 0: there is no finding.
  double amount() const {
    const std::string asset = text(buffer_uri(bytes));
    std::string said = message(asset, kSmall);
    if (said.empty()) said = message(asset, kPoses);
    const std::size_t at = said.find("which lies ");
    return at == std::string::npos ? 0 : std::stod(said.substr(at + 11));
  }
};

TEST(BoundingVolume, EnclosesTheGeometryOfItsNode) {
  Bounded asset;
  asset.box(2, 2, 2);
  asset.node(R"("mesh": 0, "boundingVolume": {"shape": 0})");
  EXPECT_EQ(asset.found(), Lines{});
  asset.json["shapes"][0]["box"]["size"] = {2, 1.5, 2};
  EXPECT_EQ(asset.found(), Lines{kSmall + " /nodes/0/boundingVolume"});
  EXPECT_NEAR(asset.amount(), 0.25, 1e-6);
}

TEST(BoundingVolume, RoundingIsTolerated) {
  Bounded asset;
  asset.box(2 - 1e-6, 2, 2);
  asset.node(R"("mesh": 0, "boundingVolume": {"shape": 0})");
  EXPECT_EQ(asset.found(), Lines{});
  asset.json["shapes"][0]["box"]["size"] = {2 - 1e-3, 2, 2};
  EXPECT_NEAR(asset.amount(), 5e-4, 1e-8);
}

TEST(BoundingVolume, IsPlacedByItsTransform) {
  Bounded asset;
  asset.box(1, 2, 2);
  // A quarter turn around z and twice the size along x of the shape, which then is y.
  asset.node(R"("mesh": 0, "boundingVolume": {"shape": 0, "scale": [2, 1, 1],
    "rotation": [0, 0, 0.70710678, 0.70710678], "translation": [0, 0.5, 0]})");
  EXPECT_NEAR(asset.amount(), 0.5, 1e-6);
}

TEST(BoundingVolume, DistancesFromEllipsoidsAreExact) {
  Bounded asset;
  asset.sphere(1);
  asset.node(R"("mesh": 0, "boundingVolume": {"shape": 0, "scale": [0.5, 3, 3]})");
  // The nearest point to (1, 1, 1) of x*x/0.25 + (y*y + z*z)/9 = 1, by samples.
  double least = 10;
  for (int i = 0; i <= 4000; ++i) {
    const double angle = std::numbers::pi / 2 * i / 4000;
    const double x = 0.5 * std::cos(angle);
    const double y = 3 * std::sin(angle) / std::sqrt(2);
    least = std::min(least, std::hypot(x - 1, y - 1, y - 1));
  }
  EXPECT_NEAR(asset.amount(), least, 1e-5);
}

TEST(BoundingVolume, EnclosesWhatIsBelowItsNode) {
  Bounded asset;
  asset.box(4, 4, 4);
  asset.node(R"("children": [1], "boundingVolume": {"shape": 0}, "scale": [7, 1, 1])");
  asset.node(R"("children": [2], "scale": [2, 2, 2])");
  asset.node(R"("mesh": 0, "extensions": {"KHR_node_visibility": {"visible": false}})");
  asset.json["extensionsUsed"] = {"KHR_node_visibility"};
  EXPECT_EQ(asset.found(), Lines{});
  asset.json["nodes"][2]["translation"] = {0, 0.5, 0};
  EXPECT_NEAR(asset.amount(), 1, 1e-6) << "in the space of the node, though hidden";
  asset.json["scenes"][0]["nodes"] = {3};
  asset.node(R"("mesh": 0)");
  EXPECT_NEAR(asset.amount(), 1, 1e-6) << "outside of the scene";
}

TEST(BoundingVolume, EnclosesCopies) {
  Bounded asset;
  asset.box(2, 2, 2);
  const std::size_t moves = asset.accessor("VEC3", 5126, 2, floats({0, 0, 0, 0, 3, 0}));
  asset.node(R"("mesh": 0, "boundingVolume": {"shape": 0})");
  asset.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", moves}};
  asset.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  EXPECT_NEAR(asset.amount(), 3, 1e-6);
}

TEST(BoundingVolume, UnusedVerticesDoNotCount) {
  Bounded asset;
  asset.box(2, 2, 2);
  asset.node(R"("mesh": 0, "boundingVolume": {"shape": 0})");
  const std::size_t far =
      asset.accessor("VEC3", 5126, 5, floats({1, 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1, 9, 9, 9}),
                     {{"min", {-1, -1, -1}}, {"max", {9, 9, 9}}});
  asset.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = far;
  EXPECT_EQ(asset.found(), Lines{});
}

TEST(BoundingVolume, FollowsItsNodeWhileThatMoves) {
  Bounded asset;
  asset.box(2, 2, 2);
  asset.node(R"("mesh": 0, "boundingVolume": {"shape": 0})");
  asset.animate(0, "translation", {0, 1}, {0, 0, 0, 9, 9, 9});
  EXPECT_EQ(asset.found(), Lines{});
}

TEST(BoundingVolume, EnclosesPosesBetweenKeyframes) {
  Bounded asset;
  asset.box(6, 6, 6);
  asset.node(R"("children": [1], "boundingVolume": {"shape": 0})");
  asset.node(R"("children": [2], "rotation": [0, 0, 0.38268343, 0.92387953])");
  asset.node(R"("mesh": 0, "translation": [2, 0, 0], "scale": [0.001, 0.001, 0.001])");
  EXPECT_EQ(asset.found(), Lines{});
  // From -45 to 45 degrees: at both the point is at x = 1.41, and halfway at 2.
  asset.json["shapes"][0]["box"]["size"] = {3, 6, 6};
  asset.animate(1, "rotation", {1, 2},
                {0, 0, -0.38268343F, 0.92387953F, 0, 0, 0.38268343F, 0.92387953F});
  EXPECT_EQ(asset.found(), Lines{kPoses + " /nodes/0/boundingVolume"});
  EXPECT_NEAR(asset.amount(), 0.501, 1e-5);
  EXPECT_NE(message(asset.text(buffer_uri(asset.bytes)), kPoses).find("at 1.5 s of animation 0"),
            std::string::npos);
  asset.json["animations"][0]["samplers"][0]["interpolation"] = "STEP";
  EXPECT_EQ(asset.found(), Lines{}) << "it jumps";
}

TEST(BoundingVolume, EnclosesMorphedMeshes) {
  Bounded asset;
  asset.box(2, 2, 2);
  const std::size_t target =
      asset.accessor("VEC3", 5126, 4, floats({0, 0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0}),
                     {{"min", {0, 0, 0}}, {"max", {0, 4, 0}}});
  asset.json["meshes"][0]["primitives"][0]["targets"] =
      AssetBuilder::Json::array({{{"POSITION", target}}});
  asset.node(R"("mesh": 0, "boundingVolume": {"shape": 0}, "weights": [0])");
  EXPECT_EQ(asset.found(), Lines{});
  asset.json["nodes"][0]["weights"] = {0.5};
  EXPECT_NEAR(asset.amount(), 2, 1e-6);
  asset.json["nodes"][0]["weights"] = {0};
  asset.animate(0, "weights", {0, 1, 2}, {0, 0.25F, 0});
  EXPECT_EQ(asset.found(), Lines{kPoses + " /nodes/0/boundingVolume"});
  EXPECT_NEAR(asset.amount(), 1, 1e-6);
}

/// The tetrahedron with a joint for each of two halves.
struct BoundedSkin : Bounded {
  BoundedSkin() {
    const std::size_t joints =
        accessor("VEC4", 5121, 4, std::string("\0\0\0\0\1\0\0\0\1\0\0\0\0\0\0\0", 16));
    const std::size_t weights =
        accessor("VEC4", 5126, 4, floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
    AssetBuilder::Json& attributes = json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = joints;
    attributes["WEIGHTS_0"] = weights;
    box(2, 2, 2);
    node(R"("children": [1, 2])");
    node(R"("name": "left", "children": [3])");
    node(R"("mesh": 0, "skin": 0, "boundingVolume": {"shape": 0})");
    node(R"("name": "right")");
    add("skins", {{"joints", {1, 3}}});
  }
};

TEST(BoundingVolume, EnclosesSkinnedMeshes) {
  BoundedSkin asset;
  EXPECT_EQ(asset.found(), Lines{});
  asset.json["nodes"][2]["translation"] = {5, 0, 0};
  EXPECT_NEAR(asset.amount(), 5, 1e-6) << "the node moves the volume only";
  asset.json["nodes"][2].erase("translation");
  asset.json["nodes"][0]["translation"] = {5, 0, 0};
  EXPECT_EQ(asset.found(), Lines{}) << "what moves both";
  asset.animate(3, "translation", {0, 1}, {0, 0, 0, 0, 0, 2});
  EXPECT_NEAR(asset.amount(), 2, 1e-5);
}

TEST(BoundingVolume, OfASkinnedMeshIsBesideTheRootOfItsJoints) {
  const std::set<std::string, std::less<>> codes{
      "BOUNDING_VOLUME_SKIN_PLACE", "NODE_SKINNED_MESH_NON_ROOT",
      "NODE_SKINNED_MESH_LOCAL_TRANSFORMS", "NODE_SKINNED_MESH_PARENT_TRANSFORMS"};
  const auto of = [&](const BoundedSkin& asset) {
    return selected(asset.text(buffer_uri(asset.bytes)), codes, Profile::strict);
  };
  BoundedSkin asset;
  asset.json["nodes"][0]["translation"] = {1, 0, 0};
  EXPECT_EQ(of(asset), Lines{});
  asset.json["nodes"][0]["children"] = {1};
  asset.json["scenes"][0]["nodes"] = {0, 2};
  EXPECT_EQ(of(asset), Lines{"BOUNDING_VOLUME_SKIN_PLACE /nodes/2/boundingVolume"});
  asset.json["nodes"][2].erase("boundingVolume");
  EXPECT_EQ(of(asset), Lines{});
}

TEST(BoundingVolume, EnclosesExternalAssets) {
  Bounded child;
  child.node(R"("mesh": 0, "translation": [0, 1, 0])");
  Bounded asset;
  asset.box(2, 4, 2);
  asset.node(R"("externalAsset": 0, "boundingVolume": {"shape": 0})");
  const std::string uri =
      "data:model/gltf+json;base64," + base64(child.text(buffer_uri(child.bytes)));
  asset.json["externalAssets"] = AssetBuilder::Json::array({{{"file", 0}}});
  asset.json["files"] =
      AssetBuilder::Json::array({{{"uri", uri}, {"mimeType", "model/gltf+json"}}});
  EXPECT_EQ(asset.found(), Lines{});
  asset.json["shapes"][0]["box"]["size"] = {2, 2, 2};
  EXPECT_NEAR(asset.amount(), 1, 1e-6);
  asset.json["files"][0]["uri"] = "missing.gltf";
  EXPECT_EQ(asset.amount(), 0);
}

/// An asset whose node 0 has the child as its external asset.
struct BoundedParent : Bounded {
  explicit BoundedParent(const std::vector<std::string>& children) {
    for (std::size_t i = 0; i < children.size(); ++i) {
      add("files", {{"uri", "data:model/gltf+json;base64," + base64(children[i])},
                    {"mimeType", "model/gltf+json"}});
      add("externalAssets", {{"file", i}});
    }
  }
  std::string said() const { return message(text(buffer_uri(bytes)), kPoses); }
};

TEST(BoundingVolume, EnclosesAnimationsOfExternalAssets) {
  Bounded child;
  child.node(R"("mesh": 0, "children": [1])");
  child.node(R"("mesh": 0, "scale": [0.1, 0.1, 0.1])");
  child.animate(1, "translation", {0, 1}, {0, 0, 0, 0, 2, 0});
  child.json["animations"][0]["name"] = "lift";
  BoundedParent asset({child.text(buffer_uri(child.bytes))});
  asset.box(2, 2, 2);
  asset.node(R"("children": [1], "boundingVolume": {"shape": 0}, "scale": [3, 3, 3])");
  asset.node(R"("externalAsset": 0, "scale": [0.5, 0.5, 0.5])");
  EXPECT_NEAR(asset.amount(), 0.05, 1e-6);
  EXPECT_EQ(asset.found(), Lines{kPoses + " /nodes/0/boundingVolume"});
  EXPECT_NE(asset.said().find("a vertex of the external asset of node 1"), std::string::npos);
  EXPECT_NE(asset.said().find("at 1 s of animation 0 ('lift') of"), std::string::npos)
      << asset.said();
  asset.json["shapes"][0]["box"]["size"] = {2, 2.1, 2};
  EXPECT_EQ(asset.found(), Lines{});
}

// Each animation plays alone: what is below the node that it moves follows.
TEST(BoundingVolume, EnclosesWhatMovesBelowExternalAssets) {
  Bounded inner;
  inner.node(R"("mesh": 0)");
  inner.animate(0, "scale", {0, 1}, {1, 1, 1, 1, 1, 3});
  BoundedParent middle({inner.text(buffer_uri(inner.bytes))});
  middle.node(R"("externalAsset": 0)");
  middle.animate(0, "translation", {0, 1}, {0, 0, 0, 2, 0, 0});
  BoundedParent asset({middle.text(buffer_uri(middle.bytes))});
  asset.box(2, 2, 2);
  asset.node(R"("externalAsset": 0, "boundingVolume": {"shape": 0})");
  EXPECT_NEAR(asset.amount(), 2, 1e-5);
  asset.json["shapes"][0]["box"]["size"] = {6, 2, 6};
  EXPECT_EQ(asset.found(), Lines{});
  asset.json["shapes"][0]["box"]["size"] = {6, 2, 2};
  EXPECT_NEAR(asset.amount(), 2, 1e-5) << "of the inner one";
}

TEST(BoundingVolume, BrokenExternalAssetsAreLeftOut) {
  Bounded child;
  child.node(R"("mesh": 0, "children": [1], "skin": 0)");
  child.node(R"("children": [0])");
  child.add("skins", {{"joints", {0, 99}}});
  child.animate(1, "translation", {0, 1}, {0, 0, 0, 0, 2, 0});
  BoundedParent asset({child.text(buffer_uri(child.bytes))});
  asset.box(2, 2, 2);
  asset.node(R"("externalAsset": 0, "boundingVolume": {"shape": 0})");
  EXPECT_EQ(asset.found(), Lines{});
}

TEST(BoundingVolume, ManyNestedVolumesAreJudged) {
  Bounded asset;
  asset.box(2, 2, 2);
  constexpr int kDepth = 300;
  for (int i = 0; i < kDepth; ++i) {
    AssetBuilder::Json node{{"boundingVolume", {{"shape", 0}}}, {"mesh", 0}};
    if (i + 1 < kDepth) node["children"] = {i + 1};
    asset.add("nodes", std::move(node));
  }
  EXPECT_EQ(asset.found(), Lines{});
  asset.json["nodes"][kDepth - 1]["translation"] = {0, 0, 1};
  EXPECT_NEAR(asset.amount(), 1, 1e-6);
}

TEST(BoundingVolume, ScaleIsAdvisedAgainst) {
  Bounded asset;
  asset.box(2, 2, 2);
  asset.node(R"("mesh": 0, "boundingVolume": {"shape": 0, "scale": [2, 2, 2]})");
  const std::string code = "NOT_RECOMMENDED";
  EXPECT_EQ(places(asset.text(buffer_uri(asset.bytes)), code),
            Lines{"/nodes/0/boundingVolume/scale"});
  asset.json["nodes"][0]["boundingVolume"]["scale"] = {1, 1, 1.0};
  EXPECT_EQ(places(asset.text(buffer_uri(asset.bytes)), code), Lines{});
}

}  // namespace
}  // namespace gltfx::test
