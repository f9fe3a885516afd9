// SPDX-License-Identifier: Apache-2.0
// Transforms, meshes, skins and children of nodes, and scenes.
#include <gtest/gtest.h>

#include "rules/part.hpp"
#include "rules/selected.hpp"

namespace gltfx::test {
namespace {

Lines transforms(const std::string& node, Profile profile = Profile::standard) {
  return findings("\"nodes\": [{" + node + "}]", {"NODE_MATRIX", "ROTATION"}, profile);
}

TEST(NodeTransform, RotationHasLengthOne) {
  EXPECT_EQ(transforms(R"("rotation": [0, 0, 0, 1])"), Lines{});
  EXPECT_EQ(transforms(R"("rotation": [0, 0, 0, 0.9924])"), Lines{});
  EXPECT_EQ(transforms(R"("rotation": [0, 0, 0, 0.992])"),
            Lines{"ROTATION_NON_UNIT /nodes/0/rotation"});
  EXPECT_EQ(transforms(R"("rotation": [0.5, 0.5, 0.5, 0.52])"),
            Lines{"ROTATION_NON_UNIT /nodes/0/rotation"});
  EXPECT_EQ(transforms(R"("rotation": [0, 0, 0, 0])"),
            Lines{"ROTATION_NON_UNIT /nodes/0/rotation"});
}

TEST(NodeTransform, MalformedRotationIsReportedOnce) {
  EXPECT_EQ(transforms(R"("rotation": [0, 0, 3])"), Lines{});
  EXPECT_EQ(transforms(R"("rotation": [0, 0, 0, 2])"), Lines{});
  EXPECT_EQ(transforms(R"("rotation": [0, 0, 0, "1"])"), Lines{});
}

TEST(NodeTransform, AZeroInTheScaleIsAnInfoUnlessItIsAnimated) {
  const std::string code = "NODE_SCALE_ZERO";
  const auto zeros = [&](const std::string& scale, const std::string& more = {}) {
    return findings(R"("nodes": [{"scale": )" + scale + "}]" + more, {code});
  };
  const Lines found{code + " /nodes/0/scale"};
  EXPECT_EQ(zeros("[1, 0, 1]"), found);
  EXPECT_EQ(zeros("[-0.0, 2, 3]"), found);
  EXPECT_EQ(zeros("[0, 0, 0]"), found);
  EXPECT_EQ(zeros("[1e-9, 1, 1]"), Lines{});
  EXPECT_EQ(zeros("[0, 1]"), Lines{}) << "reported as malformed";
  EXPECT_EQ(zeros("[0, 0, 0]", R"(, "animations": [{"samplers": [{"input": 0, "output": 1}],
      "channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}]}])"),
            Lines{});
  EXPECT_EQ(zeros("[0, 0, 0]", R"(, "animations": [{"samplers": [{"input": 0, "output": 1}],
      "channels": [{"sampler": 0, "target": {"path": "pointer",
      "extensions": {"KHR_animation_pointer": {"pointer": "/nodes/0/scale"}}}}]}])"),
            Lines{});
  EXPECT_EQ(findings(R"("nodes": [{"scale": [0, 0, 0]}])", {code}, Profile::khronos), Lines{});
}

TEST(NodeTransform, MatrixStandsAlone) {
  const std::string matrix = R"("matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 5,0,0,1])";
  EXPECT_EQ(transforms(matrix), Lines{});
  for (const char* other :
       {R"("translation": [0,0,0])", R"("rotation": [0,0,0,1])", R"("scale": [1,1,1])"}) {
    EXPECT_EQ(transforms(matrix + ", " + other), Lines{"NODE_MATRIX_TRS /nodes/0/matrix"});
  }
  EXPECT_EQ(transforms(matrix + R"(, "scale": [1, 1])"), Lines{});
}

TEST(NodeTransform, IdentityMatrixIsForNothing) {
  EXPECT_EQ(transforms(R"("matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1])"),
            Lines{"NODE_MATRIX_DEFAULT /nodes/0/matrix"});
}

TEST(NodeTransform, MatrixCanBeTakenApart) {
  const Lines wrong{"NODE_MATRIX_NON_TRS /nodes/0/matrix"};
  // Rotations by 90 and 180 degrees around each axis, mirrored and scaled: every branch of the
  // test.
  for (const char* good :
       {"0,1,0,0, -1,0,0,0, 0,0,1,0, 1,2,3,1", "1,0,0,0, 0,-1,0,0, 0,0,-1,0, 0,0,0,1",
        "-1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1", "-1,0,0,0, 0,-1,0,0, 0,0,1,0, 0,0,0,1",
        "-2,0,0,0, 0,3,0,0, 0,0,4,0, 0,0,0,1", "0,0,5,0, 0,0.1,0,0, -5,0,0,0, 0,0,0,1",
        "0.36,0.48,-0.8,0, -0.8,0.6,0,0, 0.48,0.64,0.6,0, 0,0,0,1"}) {
    EXPECT_EQ(transforms(std::string("\"matrix\": [") + good + "]"), Lines{}) << good;
  }
  for (const char* bad :
       {"1,0,0,0.1, 0,1,0,0, 0,0,1,0, 0,0,0,1", "1,0,0,0, 0,1,0,0.1, 0,0,1,0, 0,0,0,1",
        "1,0,0,0, 0,1,0,0, 0,0,1,0.1, 0,0,0,1", "1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,2",
        "1,0,0,0, 0,0,0,0, 0,0,1,0, 0,0,0,1", "1,0,0,0, 1,1,0,0, 0,0,1,0, 0,0,0,1",
        "1,0,0,0, 0,1,0,0, 0.5,0,1,0, 0,0,0,1"}) {
    EXPECT_EQ(transforms(std::string("\"matrix\": [") + bad + "]"), wrong) << bad;
  }
}

const std::string kAccessors = R"(, "accessors": [
  {"componentType": 5126, "type": "VEC3", "count": 1, "min": [0,0,0], "max": [0,0,0]},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1}])";
const std::string kMeshes = R"(, "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]},
  {"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]},
  {"primitives": [{"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}, {"POSITION": 0}]}]},
  {"primitives": [{"attributes": {"POSITION": 0, "JOINTS_1": 1, "WEIGHTS_1": 2}}]}])";

Lines meshes(const std::string& nodes, Profile profile = Profile::standard) {
  return findings(
      "\"nodes\": [" + nodes + "]" + kMeshes + kAccessors + R"(, "skins": [{"joints": [0]}])",
      {"NODE_SKIN_W", "NODE_SKINNED_MESH_WITHOUT", "NODE_WEIGHTS"}, profile);
}

TEST(NodeMesh, SkinAndJointsGoTogether) {
  EXPECT_EQ(meshes(R"({"mesh": 1, "skin": 0}, {"mesh": 0})"), Lines{});
  EXPECT_EQ(meshes(R"({"mesh": 0, "skin": 0})"), Lines{"NODE_SKIN_WITH_NON_SKINNED_MESH /nodes/0"});
  EXPECT_EQ(meshes(R"({"mesh": 1})"), Lines{"NODE_SKINNED_MESH_WITHOUT_SKIN /nodes/0"});
}

TEST(NodeMesh, EachPrimitiveOfASkinnedMeshHasJoints) {
  const auto skinned = [](const std::string& first, const std::string& second, Profile profile) {
    return findings(R"("nodes": [{"mesh": 0, "skin": 0}], "skins": [{"joints": [0]}],
                      "meshes": [{"primitives": [{"attributes": )" +
                        first + R"(}, {"attributes": )" + second + "}]}]" + kAccessors,
                    {"NODE_SKIN_W"}, profile);
  };
  const std::string joints = R"({"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 1})";
  const std::string rigid = R"({"POSITION": 0})";
  const Lines found{"NODE_SKIN_WITH_NON_SKINNED_MESH /nodes/0"};
  EXPECT_EQ(skinned(joints, joints, Profile::standard), Lines{});
  EXPECT_EQ(skinned(joints, rigid, Profile::standard), found);
  EXPECT_EQ(skinned(rigid, joints, Profile::standard), found);
  EXPECT_EQ(skinned(rigid, joints, Profile::khronos), Lines{});
  EXPECT_EQ(skinned(rigid, rigid, Profile::khronos), found);
}

TEST(NodeMesh, BrokenSkinOrJointsAreReportedOnce) {
  EXPECT_EQ(meshes(R"({"mesh": 1, "skin": 9})"), Lines{});
  EXPECT_EQ(meshes(R"({"mesh": 3, "skin": 0})"), Lines{});
  EXPECT_EQ(meshes(R"({"mesh": 3, "skin": 0})", Profile::khronos),
            Lines{"NODE_SKIN_WITH_NON_SKINNED_MESH /nodes/0"});
}

TEST(NodeMesh, WeightsMatchMorphTargets) {
  EXPECT_EQ(meshes(R"({"mesh": 2, "weights": [0, 1]})"), Lines{});
  EXPECT_EQ(meshes(R"({"mesh": 2, "weights": [0]})"),
            Lines{"NODE_WEIGHTS_INVALID /nodes/0/weights"});
  EXPECT_EQ(meshes(R"({"mesh": 0, "weights": [0]})"),
            Lines{"NODE_WEIGHTS_INVALID /nodes/0/weights"});
  EXPECT_EQ(meshes(R"({"mesh": 2, "weights": [0, "1", 2]})"), Lines{});
}

TEST(NodeMesh, NodeHasOneParent) {
  const std::vector<std::string_view> code{"NODE_PARENT"};
  EXPECT_EQ(findings(R"("nodes": [{"children": [2]}, {"children": [3, 2]}, {}, {}])", code),
            Lines{"NODE_PARENT_OVERRIDE /nodes/1/children/1"});
  EXPECT_EQ(findings(R"("nodes": [{"children": [1, 1]}, {}])", code), Lines{});
  EXPECT_EQ(findings(R"("nodes": [{"children": [1, 1]}, {}])", code, Profile::khronos),
            Lines{"NODE_PARENT_OVERRIDE /nodes/0/children/1"});
  EXPECT_EQ(findings(R"("nodes": [{"children": [1, "x"]}, {"children": [2]}, {}])", code), Lines{});
}

TEST(NodeMesh, ALoopIsNoSecondParentAsWell) {
  const std::vector<std::string_view> codes{"NODE_PARENT", "NODE_LOOP"};
  const std::string nodes = R"("nodes": [{"children": [1]}, {"children": [2]}, {"children": [1]}])";
  EXPECT_EQ(findings(nodes, codes), Lines{"NODE_LOOP /nodes/1 x2"});
  EXPECT_EQ(findings(nodes, codes, Profile::khronos),
            (Lines{"NODE_PARENT_OVERRIDE /nodes/2/children/0", "NODE_LOOP /nodes/1",
                   "NODE_LOOP /nodes/2"}));
}

TEST(Scene, TheMessageNamesTheNodes) {
  const std::string part = R"("scenes": [{"nodes": [0, 1]}],
    "nodes": [{"name": "tmpParent", "children": [1]}, {}])";
  EXPECT_EQ(message(asset(part), "SCENE_NON_ROOT_NODE"),
            "Scene 0 lists node 1 as a root, but it is a child of node 0 ('tmpParent').");
}

TEST(Scene, ListsRootsOnly) {
  const std::vector<std::string_view> code{"SCENE_"};
  EXPECT_EQ(findings(R"("scenes": [{"nodes": [0, 1]}], "nodes": [{"children": [1]}, {}])", code),
            Lines{"SCENE_NON_ROOT_NODE /scenes/0/nodes/1"});
  EXPECT_EQ(findings(R"("scenes": [{"nodes": [0, 7]}], "nodes": [{"children": [1]}, {}])", code),
            Lines{});
}

}  // namespace
}  // namespace gltfx::test
