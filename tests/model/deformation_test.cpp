// SPDX-License-Identifier: Apache-2.0
// Morph targets and skins against positions computed by hand.
#include "model/deformation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/bytes_asset.hpp"
#include "model/packed_bytes.hpp"
#include "model/pose.hpp"

namespace gltfx::model {
namespace {

using test::Accessors;
using test::BytesAsset;
using test::floats;
using test::one_mesh;
using test::packed;
using testing::ElementsAre;
using testing::FloatNear;

constexpr int kJointByte = 5121, kWeightFloat = 5126;
constexpr std::array<std::uint32_t, 1> kSetOne{1};

const std::string kTriangle = floats({0, 0, 0, 1, 0, 0, 0, 1, 0});
const std::string kUpward = floats({0, 0, 1, 0, 0, 1, 0, 0, 1});

testing::Matcher<std::array<float, 3>> near_vector(float x, float y, float z) {
  return ElementsAre(FloatNear(x, 1e-5F), FloatNear(y, 1e-5F), FloatNear(z, 1e-5F));
}

TEST(Morph, TargetsAddUpByTheirWeights) {
  Accessors accessors;
  accessors.add("VEC3", kWeightFloat, 3, kTriangle);
  accessors.add("VEC3", kWeightFloat, 3, floats({2, 0, 0, 2, 0, 0, 2, 0, 0}));
  accessors.add("VEC3", kWeightFloat, 3, floats({0, 0, 4, 0, 0, 4, 0, 0, 8}));
  const BytesAsset asset(accessors, one_mesh(R"("POSITION": 0)",
                                             R"(, "targets": [{"POSITION": 1}, {"POSITION": 2}])"));
  const auto at = [&](std::vector<float> weights) {
    return asset.read({{}, weights, {}}).geometry.positions;
  };
  EXPECT_THAT(at({}),
              ElementsAre(near_vector(0, 0, 0), near_vector(1, 0, 0), near_vector(0, 1, 0)));
  EXPECT_THAT(at({0.5F}),
              ElementsAre(near_vector(1, 0, 0), near_vector(2, 0, 0), near_vector(1, 1, 0)));
  EXPECT_THAT(at({-0.5F, 0.25F, 9}),
              ElementsAre(near_vector(-1, 0, 1), near_vector(0, 0, 1), near_vector(-1, 1, 2)));
}

TEST(Morph, TargetsCountByTheirWork) {
  Accessors accessors;
  accessors.add("VEC3", kWeightFloat, 3, kTriangle);
  const BytesAsset asset(accessors, one_mesh(R"("POSITION": 0)",
                                             R"(, "targets": [{"POSITION": 0}, {"POSITION": 0}])"));
  const std::vector<float> weights{1, 0};
  constexpr std::uint64_t kNeeded = 3 * (12 + 4) + 3 * sizeof(Triangle);
  EXPECT_EQ(asset.read({{}, weights, {}}, kNeeded).error, GeometryError::none);
  EXPECT_EQ(asset.read({{}, weights, {}}, kNeeded - 1).error, GeometryError::too_large);
}

TEST(Morph, EveryAttributeMoves) {
  Accessors accessors;
  accessors.add("VEC3", kWeightFloat, 3, kTriangle);
  accessors.add("VEC3", kWeightFloat, 3, kUpward);
  accessors.add("VEC4", kWeightFloat, 3, floats({1, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, -1}));
  accessors.add("VEC2", kWeightFloat, 3, floats({0, 0, 1, 0, 0, 1}));
  accessors.add("VEC3", kWeightFloat, 3, floats({0, 0, 0, 0.5F, 0.5F, 0.5F, 1, 1, 1}));
  accessors.add("VEC3", kWeightFloat, 3, floats({0, 1, -1, 0, 0, 0, 0, 0, 0}));
  accessors.add("VEC2", kWeightFloat, 3, floats({3, 4, 0, 0, 0, 0}));
  accessors.add("VEC3", kWeightFloat, 3, floats({0.5F, 0, 0, 9, -9, 0, 0, 0, 0}));
  const BytesAsset asset(
      accessors,
      one_mesh(R"("POSITION": 0, "NORMAL": 1, "TANGENT": 2, "TEXCOORD_1": 3, "COLOR_0": 4)",
               R"(, "targets": [{"NORMAL": 5, "TANGENT": 5, "TEXCOORD_1": 6, "COLOR_0": 7}])"));
  const std::vector<float> weights{1};
  const auto read = asset.read({kSetOne, weights, {}});
  EXPECT_THAT(read.geometry.normals[0], near_vector(0, 1, 0));
  EXPECT_THAT(read.geometry.normals[1], near_vector(0, 0, 1));
  const float third = std::sqrt(1.0F / 3);
  EXPECT_THAT(
      read.geometry.tangents[0],
      ElementsAre(FloatNear(third, 1e-5F), FloatNear(third, 1e-5F), FloatNear(-third, 1e-5F), -1));
  EXPECT_THAT(read.geometry.tex_coords[0][0], ElementsAre(3, 4));
  EXPECT_THAT(read.geometry.colors[0], ElementsAre(0.5F, 0, 0, 1));
  EXPECT_THAT(read.geometry.colors[1], ElementsAre(1, 0, 0.5F, 1)) << "colours stay colours";
}

// Two joints: one does not move, one is rotated by 90 degrees about z and translated.
const std::vector<Affine> kJoints{
    Affine(), Affine::from_parts({10, 0, 0}, {0, 0, std::sqrt(0.5), std::sqrt(0.5)}, {1, 1, 1})};

Accessors skinned_triangle(const std::string& weights) {
  Accessors accessors;
  accessors.add("VEC3", kWeightFloat, 3, kTriangle);
  accessors.add("VEC3", kWeightFloat, 3, floats({1, 0, 0, 1, 0, 0, 1, 0, 0}));
  accessors.add("VEC4", kJointByte, 3, packed<std::uint8_t>({0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}));
  accessors.add("VEC4", kWeightFloat, 3, weights);
  return accessors;
}
const std::string kSkinned =
    one_mesh(R"("POSITION": 0, "NORMAL": 1, "JOINTS_0": 2, "WEIGHTS_0": 3)");

TEST(Skin, VerticesFollowTheirJoints) {
  const BytesAsset asset(skinned_triangle(floats({1, 0, 0, 0, 1, 0, 0, 0, 0.5F, 0.5F, 0, 0})),
                         kSkinned);
  const auto read = asset.read({{}, {}, kJoints});
  // (1, 0, 0) turns to (0, 1, 0) and moves by 10; the last one is between (0, 1, 0) and (9, 0, 0).
  EXPECT_THAT(read.geometry.positions,
              ElementsAre(near_vector(0, 0, 0), near_vector(10, 1, 0), near_vector(4.5F, 0.5F, 0)));
  const float half = std::sqrt(0.5F);
  EXPECT_THAT(read.geometry.normals,
              ElementsAre(near_vector(1, 0, 0), near_vector(0, 1, 0), near_vector(half, half, 0)));
}

TEST(Skin, WeightsAreBroughtToOneAndMissingOnesFollowTheFirstJoint) {
  const BytesAsset asset(skinned_triangle(floats({2, 2, 0, 0, 0, 0, 0, 0, -1, 4, 0, 0})), kSkinned);
  const auto read = asset.read({{}, {}, kJoints});
  EXPECT_THAT(read.geometry.positions,
              ElementsAre(near_vector(5, 0, 0), near_vector(10, 1, 0), near_vector(9, 0, 0)));
}

TEST(Skin, SeveralSetsCountTogether) {
  Accessors accessors = skinned_triangle(floats({0.5F, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
  accessors.add("VEC4", kJointByte, 3, packed<std::uint8_t>({1, 0, 0, 0, 7, 0, 0, 0, 0, 0, 0, 0}));
  accessors.add("VEC4", kJointByte, 3, packed<std::uint8_t>({0, 0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0}),
                R"(, "normalized": true)");
  accessors.add("VEC4", kWeightFloat, 3, floats({0.5F, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}));
  const std::string base = R"("POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3, "JOINTS_1": 4, )";
  const BytesAsset floats_asset(accessors, one_mesh(base + R"("WEIGHTS_1": 6)"));
  // The joint 7 of the second vertex is unknown.
  EXPECT_THAT(floats_asset.read({{}, {}, kJoints}).geometry.positions,
              ElementsAre(near_vector(5, 0, 0), near_vector(10, 1, 0), near_vector(0, 1, 0)));
  const BytesAsset bytes_asset(accessors, one_mesh(base + R"("WEIGHTS_1": 5)"));
  EXPECT_THAT(bytes_asset.read({{}, {}, kJoints}).geometry.positions[0], near_vector(0, 0, 0));
}

TEST(Skin, MirrorsTurnTheHandednessAround) {
  Accessors accessors;
  accessors.add("VEC3", kWeightFloat, 3, kTriangle);
  accessors.add("VEC3", kWeightFloat, 3, kUpward);
  accessors.add("VEC4", kWeightFloat, 3, floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}));
  accessors.add("VEC4", kJointByte, 3, std::string(12, '\0'));
  accessors.add("VEC4", kWeightFloat, 3, floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
  const BytesAsset asset(
      accessors,
      one_mesh(R"("POSITION": 0, "NORMAL": 1, "TANGENT": 2, "JOINTS_0": 3, "WEIGHTS_0": 4)"));
  const std::vector<Affine> mirror{Affine::from_parts({0, 0, 0}, {0, 0, 0, 1}, {-2, 1, 1})};
  const auto read = asset.read({{}, {}, mirror});
  EXPECT_THAT(read.geometry.normals[0], near_vector(0, 0, 1));
  EXPECT_THAT(read.geometry.tangents[0], ElementsAre(-1, 0, 0, -1));
}

TEST(Skin, MatricesTakeTheMeshFromItsBindingToTheJoints) {
  Accessors accessors;
  accessors.add("MAT4", kWeightFloat, 2,
                floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0,  0,  1,  //
                        1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, -2, -3, 1}));
  const BytesAsset asset(accessors, R"("skins": [{"joints": [1, 0], "inverseBindMatrices": 0},
 {"joints": [1]}, {"joints": [9]}], "nodes": [{"translation": [5, 0, 0], "children": [1]}, {"scale": [2, 2, 2]}],
 "scenes": [{"nodes": [0]}])");
  const Pose pose = compute_pose(asset.asset(), asset.views(), {{0}, {}});
  const auto matrices = joint_matrices(asset.asset(), asset.views(), asset.resources(), 0, pose);
  ASSERT_EQ(matrices.size(), 2U);
  EXPECT_EQ(matrices[0].point({1, 1, 1}), (Vector3{7, 2, 2}));
  EXPECT_EQ(matrices[1].point({1, 2, 3}), (Vector3{5, 0, 0}));
  EXPECT_EQ(
      joint_matrices(asset.asset(), asset.views(), asset.resources(), 1, pose)[0].point({0, 0, 1}),
      (Vector3{5, 0, 2}));
  EXPECT_TRUE(joint_matrices(asset.asset(), asset.views(), asset.resources(), 2, pose).empty());
}

}  // namespace
}  // namespace gltfx::model
