// SPDX-License-Identifier: Apache-2.0
// The scene graph as a whole, and skins in it.
#include <gtest/gtest.h>

#include "rules/part.hpp"

namespace gltfx::test {
namespace {

const std::string kMesh = R"(, "meshes": [{"primitives": [{"mode": 0,
  "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}], "accessors": [
  {"componentType": 5126, "type": "VEC3", "count": 1, "min": [0,0,0], "max": [0,0,0]},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1},
  {"componentType": 5126, "type": "MAT4", "count": 1}])";

Lines graph(const std::string& members, const std::vector<std::string_view>& codes,
            Profile profile = Profile::standard) {
  return findings(members + kMesh, codes, profile);
}

TEST(NodeGraph, NodeForNothingIsEmpty) {
  const std::vector<std::string_view> code{"NODE_EMPTY"};
  EXPECT_EQ(graph(R"("nodes": [{"name": "x", "translation": [1, 0, 0]}, {}])", code),
            Lines{"NODE_EMPTY /nodes/0 x2"});
  EXPECT_EQ(graph(R"("nodes": [{"children": [1]}, {"extras": {}}, {"mesh": 0}])", code), Lines{});
  EXPECT_EQ(graph(R"("nodes": [{}], "skins": [{"joints": [0]}])", code), Lines{});
  EXPECT_EQ(graph(R"("extensionsUsed": ["X_y"], "nodes": [{"extensions": {"X_y": {}}}])", code),
            Lines{});
}

TEST(NodeGraph, WhatLeadsNowhereIsReportedOnce) {
  const std::vector<std::string_view> code{"NODE_EMPTY"};
  EXPECT_EQ(graph(R"("nodes": [{"mesh": 9}])", code), Lines{});
  EXPECT_EQ(graph(R"("nodes": [{"mesh": 9}])", code, Profile::khronos),
            Lines{"NODE_EMPTY /nodes/0"});
}

TEST(NodeGraph, AnyExtensionFillsANodeButForKhronosOneThatIsNotAtHomeThere) {
  const std::string nodes = R"("nodes": [{"extensions": {"X_y": {}}}])";
  EXPECT_EQ(graph(nodes, {"NODE_EMPTY"}), Lines{});
  EXPECT_EQ(graph(nodes, {"NODE_EMPTY"}, Profile::khronos), Lines{});
  const std::string lost = R"("extensionsUsed": ["KHR_materials_unlit"],
    "nodes": [{"extensions": {"KHR_materials_unlit": {}}}])";
  EXPECT_EQ(graph(lost, {"NODE_EMPTY"}), Lines{});
  EXPECT_EQ(graph(lost, {"NODE_EMPTY"}, Profile::khronos), Lines{"NODE_EMPTY /nodes/0"});
}

TEST(NodeGraph, LoopsAreTheNodesOnThem) {
  const std::vector<std::string_view> code{"NODE_LOOP"};
  EXPECT_EQ(graph(R"("nodes": [{"children": [0]}])", code), Lines{"NODE_LOOP /nodes/0"});
  EXPECT_EQ(graph(R"("nodes": [{"children": [1]}, {"children": [2]}, {"children": [1, 3]}, {}])",
                  code, Profile::khronos),
            (Lines{"NODE_LOOP /nodes/1", "NODE_LOOP /nodes/2"}));
  EXPECT_EQ(graph(R"("nodes": [{"children": [1]}, {"children": [2]}, {}])", code), Lines{});
}

TEST(NodeGraph, TransformsDoNotReachASkinnedMesh) {
  const std::vector<std::string_view> code{"NODE_SKINNED"};
  const std::string skin = R"(, "skins": [{"joints": [0]}])";
  EXPECT_EQ(graph(R"("nodes": [{}, {"mesh": 0, "skin": 0}])" + skin, code), Lines{});
  EXPECT_EQ(graph(R"("nodes": [{}, {"mesh": 0, "skin": 0, "scale": [1, 1, 2]}])" + skin, code),
            Lines{"NODE_SKINNED_MESH_LOCAL_TRANSFORMS /nodes/1"});
  EXPECT_EQ(graph(R"("nodes": [{}, {"mesh": 0, "skin": 0, "scale": [1, 1, 1]}])" + skin, code),
            Lines{});
  EXPECT_EQ(graph(R"("nodes": [{"children": [1]}, {"mesh": 0, "skin": 0}])" + skin, code),
            Lines{"NODE_SKINNED_MESH_NON_ROOT /nodes/1"});
}

TEST(NodeGraph, TransformFarAboveASkinnedMeshCounts) {
  const std::vector<std::string_view> code{"NODE_SKINNED"};
  const std::string members = R"("nodes": [{"children": [1], "translation": [1, 0, 0]},
   {"children": [2]}, {"mesh": 0, "skin": 0}], "skins": [{"joints": [0]}])";
  EXPECT_EQ(graph(members, code), Lines{"NODE_SKINNED_MESH_PARENT_TRANSFORMS /nodes/2"});
  EXPECT_EQ(graph(members, code, Profile::khronos),
            (Lines{"NODE_SKINNED_MESH_PARENT_TRANSFORMS /nodes/2",
                   "NODE_SKINNED_MESH_NON_ROOT /nodes/2"}));
}

TEST(NodeGraph, SceneWithASkinnedMeshHasItsJoints) {
  const std::vector<std::string_view> code{"NODE_SKIN_NO_SCENE"};
  const std::string rest = R"(, "nodes": [{"mesh": 0, "skin": 0}, {"children": [2]}, {}],
   "skins": [{"joints": [2]}])";
  EXPECT_EQ(graph(R"("scenes": [{"nodes": [0, 1]}])" + rest, code), Lines{});
  EXPECT_EQ(graph(R"("scenes": [{"nodes": [0, 1]}, {"nodes": [0]}])" + rest, code),
            Lines{"NODE_SKIN_NO_SCENE /nodes/0"});
  EXPECT_EQ(graph(R"("scenes": [{"nodes": [1]}])" + rest, code), Lines{});
}

Lines skins(const std::string& nodes, const std::string& skin,
            Profile profile = Profile::standard) {
  return graph("\"nodes\": [" + nodes + "], \"skins\": [{" + skin + "}]", {"SKIN_", "INVALID_IBM"},
               profile);
}

TEST(Skin, JointsHaveACommonRoot) {
  EXPECT_EQ(skins(R"({"children": [1, 2]}, {}, {})", R"("joints": [1, 2])"), Lines{});
  EXPECT_EQ(skins("{}, {}", R"("joints": [0, 1])"), Lines{"SKIN_NO_COMMON_ROOT /skins/0/joints"});
  EXPECT_EQ(skins(R"({"children": [1]}, {"children": [0]})", R"("joints": [0, 1])"), Lines{});
}

TEST(Skin, UnresolvedJointIsReportedOnce) {
  EXPECT_EQ(skins("{}, {}", R"("joints": [0, 1, 5])"), Lines{});
  EXPECT_EQ(skins("{}", R"("joints": [5])", Profile::khronos),
            Lines{"SKIN_NO_COMMON_ROOT /skins/0/joints"});
}

TEST(Skin, SkeletonIsAboveAllJoints) {
  const std::string tree = R"({"children": [1]}, {"children": [2, 3]}, {}, {}, {})";
  const Lines wrong{"SKIN_SKELETON_INVALID /skins/0/skeleton"};
  for (const char* root : {"0", "1"}) {
    EXPECT_EQ(skins(tree, std::string(R"("joints": [2, 3], "skeleton": )") + root), Lines{});
  }
  for (const char* root : {"2", "4"}) {
    EXPECT_EQ(skins(tree, std::string(R"("joints": [2, 3], "skeleton": )") + root), wrong);
  }
  EXPECT_EQ(skins(tree, R"("joints": [1, 3], "skeleton": 1)"), Lines{});
}

TEST(Skin, MatricesAreOneForEachJoint) {
  EXPECT_EQ(skins("{}", R"("joints": [0], "inverseBindMatrices": 3)"), Lines{});
  EXPECT_EQ(skins(R"({"children": [1]}, {})", R"("joints": [0, 1], "inverseBindMatrices": 3)"),
            Lines{"INVALID_IBM_ACCESSOR_COUNT /skins/0/inverseBindMatrices"});
  EXPECT_EQ(skins("{}", R"("joints": [0], "inverseBindMatrices": 2)"),
            Lines{"SKIN_IBM_INVALID_FORMAT /skins/0/inverseBindMatrices"});
}

// A chain of nodes, each the child of the previous one, the last one a skinned mesh.
std::string chain(std::size_t length) {
  std::string nodes = "\"nodes\": [{\"mesh\": 0, \"skin\": 0}";
  for (std::size_t i = 1; i < length; ++i)
    nodes += ", {\"children\": [" + std::to_string(i - 1) + "]}";
  return nodes + "], \"skins\": [{\"joints\": [1, 2], \"skeleton\": 5}]";
}

TEST(NodeGraph, DeepChainsAndLongLoopsAreNoProblem) {
  EXPECT_EQ(graph(chain(100000), {"NODE_SKINNED", "SKIN_", "NODE_LOOP"}),
            Lines{"NODE_SKINNED_MESH_NON_ROOT /nodes/0"});
  std::string loop = "\"nodes\": [{\"children\": [99999]}";
  for (int i = 1; i < 100000; ++i) loop += ", {\"children\": [" + std::to_string(i - 1) + "]}";
  EXPECT_EQ(graph(loop + "]", {"NODE_LOOP"}), Lines{"NODE_LOOP /nodes/0 x100000"});
}

}  // namespace
}  // namespace gltfx::test
