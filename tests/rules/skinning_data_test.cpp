// SPDX-License-Identifier: Apache-2.0
// Data of animations and skins: times, rotations, matrices, joints and weights over all sets.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "rules/data_asset.hpp"

namespace gltfx::test {
namespace {

// One channel of path `path`, with `output` as its values.
std::string animation_of_weights(std::initializer_list<float> times, const std::string& path,
                                 const std::string& type, Component component,
                                 const std::string& output,
                                 const std::string& interpolation = "LINEAR") {
  DataAsset asset;
  asset.accessor("SCALAR", kFloat, times.size(), floats(times), R"(, "min": [0], "max": [1])");
  const std::size_t size = component == kFloat ? 16 : 4;
  asset.accessor(type, component, output.size() / size, output,
                 component == kFloat ? "" : R"(, "normalized": true)");
  return asset.text(R"("nodes": [{}], "animations": [{"samplers": [{"input": 0, "output": 1,
      "interpolation": ")" +
                    interpolation +
                    R"("}], "channels": [{"sampler": 0, "target": {"node": 0, "path": ")" + path +
                    R"("}}]}])");
}

Lines about_animation(const std::string& asset, Profile profile = Profile::standard) {
  return selected(asset,
                  {"ACCESSOR_ANIMATION_INPUT_NEGATIVE", "ACCESSOR_ANIMATION_INPUT_NON_INCREASING",
                   "ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION"},
                  profile);
}

Lines times(std::initializer_list<float> values, Profile profile = Profile::standard) {
  return about_animation(
      animation_of_weights(values, "scale", "VEC4", kFloat, std::string(16, '\0')), profile);
}

TEST(Times, Increase) {
  const std::string order =
      "ACCESSOR_ANIMATION_INPUT_NON_INCREASING /animations/0/samplers/0/input";
  EXPECT_EQ(times({0, 1, 2}), Lines());
  EXPECT_EQ(times({0, 1, 1}), (Lines{order}));
  EXPECT_EQ(times({3, 1, 2}), (Lines{order}));
  EXPECT_EQ(times({1, 1, 1}), (Lines{order + " x2"}));
  EXPECT_EQ(times({1, 1, 1}, Profile::khronos), (Lines{order, order}));
}

TEST(Times, AreNotNegativeAndThoseAreNotComparedWith) {
  const std::string below = "ACCESSOR_ANIMATION_INPUT_NEGATIVE /animations/0/samplers/0/input";
  const std::string order =
      "ACCESSOR_ANIMATION_INPUT_NON_INCREASING /animations/0/samplers/0/input";
  EXPECT_EQ(times({-1, 1}), (Lines{below}));
  EXPECT_EQ(times({2, -1, 3}), (Lines{below}));
  EXPECT_EQ(times({2, -1, 1}), (Lines{below, order}));
  EXPECT_EQ(times({-0.0F, 1}), Lines());
}

const std::string kChannel =
    "ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION /animations/0/channels/0/sampler";

Lines rotation(const std::string& values, const std::string& interpolation = "LINEAR") {
  return about_animation(
      animation_of_weights({0}, "rotation", "VEC4", kFloat, values, interpolation));
}

TEST(Rotations, AreOfUnitLengthWithinWhatEightBitsLose) {
  EXPECT_EQ(rotation(floats({0, 0, 0, 1})), Lines());
  EXPECT_EQ(rotation(floats({0, 0, 0, 1.00768F})), Lines());
  EXPECT_EQ(rotation(floats({0, 0, 0, 0.99232F})), Lines());
  EXPECT_EQ(rotation(floats({0, 0, 0, 1.0077F})), (Lines{kChannel}));
  EXPECT_EQ(rotation(floats({0, 0, 0, 0.9923F})), (Lines{kChannel}));
  EXPECT_EQ(rotation(floats({0, 0, 0, 0})), (Lines{kChannel}));
}

TEST(Rotations, OfOtherPathsMayHaveAnyLength) {
  EXPECT_EQ(
      about_animation(animation_of_weights({0}, "weights", "VEC4", kFloat, floats({5, 5, 5, 5}))),
      Lines());
}

TEST(Rotations, OfSplinesAreTheMiddleOnesOfThree) {
  const std::string spline = floats({9, 9, 9, 9, 0, 0, 0, 1, 9, 9, 9, 9});
  EXPECT_EQ(rotation(spline, "CUBICSPLINE"), Lines());
  EXPECT_EQ(rotation(spline), (Lines{kChannel + " x2"}));
  EXPECT_EQ(rotation(floats({0, 0, 0, 1, 9, 9, 9, 9, 0, 0, 0, 1}), "CUBICSPLINE"),
            (Lines{kChannel}));
}

TEST(Rotations, OfNormalizedIntegersAreConvertedFirst) {
  EXPECT_EQ(about_animation(animation_of_weights({0}, "rotation", "VEC4", kInt8,
                                                 packed<std::int8_t>({0, 0, 0, -127}))),
            Lines());
  EXPECT_EQ(about_animation(animation_of_weights({0}, "rotation", "VEC4", kInt8,
                                                 packed<std::int8_t>({0, 0, 0, 100}))),
            (Lines{kChannel}));
}

TEST(BindMatrices, EndInARowOfZerosAndAOne) {
  const auto matrices = [](std::size_t place, float value) {
    std::vector<float> matrix(16, 7);
    for (const std::size_t zero : {3U, 7U, 11U}) matrix[zero] = 0;
    matrix[15] = 1;
    matrix[place] = value;
    DataAsset asset;
    asset.accessor("MAT4", kFloat, 1, packed(matrix));
    return about_data(
        asset.text(R"("nodes": [{}], "skins": [{"joints": [0], "inverseBindMatrices": 0}])"));
  };
  const Lines error{"ACCESSOR_INVALID_IBM /skins/0/inverseBindMatrices"};
  EXPECT_EQ(matrices(0, 5), Lines());
  EXPECT_EQ(matrices(14, 5), Lines());
  EXPECT_EQ(matrices(3, 1e-9F), error);
  EXPECT_EQ(matrices(7, 1), error);
  EXPECT_EQ(matrices(11, -1), error);
  EXPECT_EQ(matrices(15, 0.9999999F), error);
}

// One vertex, with a skin of three joints.
class Vertex {
 public:
  Vertex& set(std::initializer_list<std::uint8_t> joints, std::initializer_list<float> weights) {
    return set(joints, kFloat, floats(weights));
  }
  Vertex& set(std::initializer_list<std::uint8_t> joints, Component component,
              const std::string& weights) {
    const std::string number = std::to_string(sets_++);
    const std::size_t count = joints.size() / 4;
    const std::size_t place = asset_.accessor("VEC4", kUint8, count, packed<std::uint8_t>(joints));
    asset_.accessor("VEC4", component, count, weights,
                    component == kFloat ? "" : R"(, "normalized": true)");
    attributes_ += R"(, "JOINTS_)" + number + R"(": )" + std::to_string(place) + R"(, "WEIGHTS_)" +
                   number + R"(": )" + std::to_string(place + 1);
    return *this;
  }
  Lines found(Profile profile = Profile::standard, const std::string& skin = "0, 1, 2") {
    const std::size_t position =
        asset_.accessor("VEC3", kFloat, 1, "", R"(, "min": [0, 0, 0], "max": [0, 0, 0])");
    Lines lines = about_data(
        asset_.text(R"("nodes": [{}, {}, {"mesh": 0, "skin": 0}], "skins": [{"joints": [)" + skin +
                    "]}], " +
                    mesh(attributes_.substr(2) + R"(, "POSITION": )" + std::to_string(position),
                         R"(, "mode": 0)")),
        profile);
    const std::string place = " /meshes/0/primitives/0/attributes";
    for (std::string& line : lines) {
      if (line.starts_with("ACCESSOR_")) line.erase(0, 9);
      const std::size_t at = line.find(place);
      if (at != std::string::npos) line.erase(at + 1, place.size());
    }
    return lines;
  }

 private:
  DataAsset asset_;
  std::string attributes_;
  int sets_ = 0;
};

TEST(Influences, ThatAreRightAreSilent) {
  EXPECT_EQ(Vertex().set({0, 1, 0, 0}, {0.5F, 0.5F, 0, 0}).found(), Lines());
  EXPECT_EQ(Vertex().set({0, 1, 2, 0}, kUint8, packed<std::uint8_t>({100, 100, 55, 0})).found(),
            Lines());
}

TEST(Influences, NameJointsOfTheSkin) {
  EXPECT_EQ(Vertex().set({3, 0, 0, 0}, {0, 1, 0, 0}).found(), (Lines{"JOINTS_INDEX_OOB JOINTS_0"}));
  EXPECT_EQ(Vertex().set({2, 0, 0, 0}, {1, 0, 0, 0}).found(), Lines());
}

TEST(Influences, TheSmallestSkinDecides) {
  EXPECT_EQ(Vertex().set({1, 0, 0, 0}, {1, 0, 0, 0}).found(Profile::standard, "0"),
            (Lines{"JOINTS_INDEX_OOB JOINTS_0"}));
}

TEST(Influences, OfJointsThatAreReportedCountInTheSum) {
  const Lines outside{"JOINTS_INDEX_OOB JOINTS_0"};
  EXPECT_EQ(Vertex().set({3, 0, 0, 0}, {1, 0, 0, 0}).found(), outside);
  EXPECT_EQ(Vertex().set({3, 1, 0, 0}, {0.5F, 0.5F, 0, 0}).found(), outside);
  EXPECT_EQ(Vertex().set({3, 1, 0, 0}, {0.5F, 0.25F, 0, 0}).found(),
            (Lines{"JOINTS_INDEX_OOB JOINTS_0", "WEIGHTS_NON_NORMALIZED WEIGHTS_0"}));
  EXPECT_EQ(Vertex().set({1, 1, 0, 0}, {0.5F, 0.5F, 0, 0}).found(),
            (Lines{"JOINTS_INDEX_DUPLICATE JOINTS_0"}));
  // A negative weight is the only error.
  EXPECT_EQ(Vertex().set({0, 1, 0, 0}, {1.25F, -0.25F, 0, 0}).found(),
            (Lines{"WEIGHTS_NEGATIVE WEIGHTS_0"}));
  EXPECT_EQ(Vertex().set({3, 0, 0, 0}, {1, 0, 0, 0}).found(Profile::khronos).size(), 2U);
}

TEST(Influences, NameAJointOnceOverAllSets) {
  EXPECT_EQ(
      Vertex().set({1, 0, 0, 0}, {0.75F, 0, 0, 0}).set({1, 0, 0, 0}, {0.25F, 0, 0, 0}).found(),
      (Lines{"JOINTS_INDEX_DUPLICATE JOINTS_1"}));
}

TEST(Influences, AreNotNegative) {
  EXPECT_EQ(Vertex().set({0, 1, 0, 0}, {1, -0.25F, 0, 0}).found(),
            (Lines{"WEIGHTS_NEGATIVE WEIGHTS_0"}));
}

TEST(Influences, WithoutWeightNameTheFirstJoint) {
  EXPECT_EQ(Vertex().set({0, 2, 0, 0}, {1, 0, 0, 0}).found(),
            (Lines{"JOINTS_USED_ZERO_WEIGHT JOINTS_0"}));
}

TEST(Influences, SumUpToOneOverAllSets) {
  EXPECT_EQ(Vertex().set({0, 0, 0, 0}, {0.5F, 0, 0, 0}).set({1, 0, 0, 0}, {0.5F, 0, 0, 0}).found(),
            Lines());
  EXPECT_EQ(Vertex().set({0, 0, 0, 0}, {0.5F, 0, 0, 0}).set({1, 0, 0, 0}, {0.25F, 0, 0, 0}).found(),
            (Lines{"WEIGHTS_NON_NORMALIZED WEIGHTS_0", "WEIGHTS_NON_NORMALIZED WEIGHTS_1"}));
}

TEST(Influences, TheToleranceGrowsWithTheNumberOfWeights) {
  const float above = std::nextafter(std::nextafter(1.0F, 2.0F), 2.0F);  // 1 + 2.4e-7
  EXPECT_EQ(Vertex().set({0, 0, 0, 0}, {std::nextafter(1.0F, 2.0F), 0, 0, 0}).found(), Lines());
  EXPECT_EQ(Vertex().set({0, 0, 0, 0}, {above, 0, 0, 0}).found(),
            (Lines{"WEIGHTS_NON_NORMALIZED WEIGHTS_0"}));
  EXPECT_EQ(Vertex().set({0, 1, 0, 0}, {above - 0.5F, 0.5F, 0, 0}).found(), Lines());
  EXPECT_EQ(Vertex().set({0, 0, 0, 0}, {above, 0.5F, 0, 0}).found(),
            (Lines{"JOINTS_INDEX_DUPLICATE JOINTS_0", "WEIGHTS_NON_NORMALIZED WEIGHTS_0"}));
}

TEST(Influences, OfAMeshThatNoSkinDeformsAreNotLookedAt) {
  DataAsset asset;
  asset.accessor("VEC4", kUint8, 1, packed<std::uint8_t>({9, 9, 9, 9}));
  asset.accessor("VEC4", kFloat, 1, floats({9, 9, 9, 9}));
  EXPECT_EQ(about_data(asset.text(R"("nodes": [{"mesh": 0}, {}], "skins": [{"joints": [1]}], )" +
                                  mesh(R"("JOINTS_0": 0, "WEIGHTS_0": 1)"))),
            Lines());
}

TEST(Influences, TheKhronosProfileListsThemComponentByComponent) {
  EXPECT_EQ(
      Vertex()
          .set({9, 0, 9, 0}, {0.5F, 0.5F, 0, 0})
          .set({0, 9, 0, 0}, {0, 0, 0, 0})
          .found(Profile::khronos),
      (Lines{"JOINTS_INDEX_OOB JOINTS_0", "JOINTS_INDEX_OOB JOINTS_1", "JOINTS_INDEX_OOB JOINTS_0",
             "WEIGHTS_NON_NORMALIZED WEIGHTS_0", "WEIGHTS_NON_NORMALIZED WEIGHTS_1"}));
}

}  // namespace
}  // namespace gltfx::test
