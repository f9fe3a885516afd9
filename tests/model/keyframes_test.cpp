// SPDX-License-Identifier: Apache-2.0
// Curves between keyframes against values computed by hand.
#include "model/keyframes.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/bytes_asset.hpp"
#include "model/packed_bytes.hpp"
#include "model/pose.hpp"
#include "schema/compile.hpp"

namespace gltfx::model {
namespace {

using test::Accessors;
using test::BytesAsset;
using test::floats;
using test::packed;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

constexpr int kKeyByte = 5120, kKeyUnsignedByte = 5121, kKeyFloat = 5126;

// One channel; accessor 0 has the times, 1 the values.
std::string animation(const std::string& interpolation, const std::string& target) {
  return R"("animations": [{"samplers": [{"input": 0, "output": 1, "interpolation": ")" +
         interpolation + R"("}], "channels": [{"sampler": 0, "target": )" + target + "}]}]";
}
std::string on_node(const std::string& path) { return R"({"node": 0, "path": ")" + path + R"("})"; }
std::string on_pointer(const std::string& pointer) {
  return R"({"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": ")" + pointer +
         R"("}}})";
}

AnimationSample sample(const BytesAsset& asset, double time) {
  const auto schemas = schema::builtin_set();
  return sample_animation(asset.asset(), asset.views(), asset.resources(), *schemas, 0, time);
}

std::vector<float> value(const BytesAsset& asset, double time) {
  const AnimationSample sampled = sample(asset, time);
  EXPECT_THAT(sampled.notes, IsEmpty());
  return sampled.values.size() == 1 ? sampled.values.begin()->second : std::vector<float>();
}

BytesAsset moving(const std::string& interpolation, std::initializer_list<float> values) {
  Accessors accessors;
  accessors.add("SCALAR", kKeyFloat, 2, floats({1, 3}));
  accessors.add("VEC3", kKeyFloat, values.size() / 3, floats(values));
  return {accessors, animation(interpolation, on_node("translation")) + R"(, "nodes": [{}])"};
}

TEST(Keyframes, LinearCurvesEndWhereTheirKeyframesEnd) {
  const BytesAsset asset = moving("LINEAR", {0, 0, 0, 4, 8, -2});
  EXPECT_THAT(value(asset, -5), ElementsAre(0, 0, 0));
  EXPECT_THAT(value(asset, 1), ElementsAre(0, 0, 0));
  EXPECT_THAT(value(asset, 1.5), ElementsAre(1, 2, -0.5F));
  EXPECT_THAT(value(asset, 3), ElementsAre(4, 8, -2));
  EXPECT_THAT(value(asset, 100), ElementsAre(4, 8, -2));
}

TEST(Keyframes, StepsHoldUntilTheNextKeyframe) {
  const BytesAsset asset = moving("STEP", {0, 0, 0, 4, 8, -2});
  EXPECT_THAT(value(asset, 2.999), ElementsAre(0, 0, 0));
  EXPECT_THAT(value(asset, 3), ElementsAre(4, 8, -2));
}

TEST(Keyframes, SplinesFollowTheirTangents) {
  // In-tangent, value, out-tangent of both keyframes, two seconds apart.
  const BytesAsset asset = moving("CUBICSPLINE", {9, 9, 9, 0, 1, 0, 1, 0, 0,  //
                                                  0, 0, 2, 4, 1, 0, 9, 9, 9});
  EXPECT_THAT(value(asset, 0), ElementsAre(0, 1, 0));
  EXPECT_THAT(value(asset, 3), ElementsAre(4, 1, 0));
  // At t = 1/2: half of both values, and 2 * (1/8) of the out- less that of the in-tangent.
  EXPECT_THAT(value(asset, 2), ElementsAre(2.25F, 1, -0.5F));
  // At t = 1/4: 27/32 and 5/32 of the values, 2 * 9/64 and -2 * 3/64 of the tangents.
  EXPECT_THAT(value(asset, 1.5),
              ElementsAre(FloatNear(0.625F + 0.28125F, 1e-6F), 1, FloatNear(-0.1875F, 1e-6F)));
}

TEST(Keyframes, RotationsTurnTheShortWayAround) {
  const float half = std::sqrt(0.5F);
  Accessors accessors;
  accessors.add("SCALAR", kKeyFloat, 2, floats({0, 1}));
  // 90 degrees about z, with all signs turned around: the same rotation.
  accessors.add("VEC4", kKeyFloat, 2, floats({0, 0, 0, 1, 0, 0, -half, -half}));
  const BytesAsset asset(accessors,
                         animation("LINEAR", on_node("rotation")) + R"(, "nodes": [{}])");
  const float angle = 3.14159265F / 12;  // half of a third of it
  EXPECT_THAT(value(asset, 1.0 / 3), ElementsAre(0, 0, FloatNear(std::sin(angle), 1e-6F),
                                                 FloatNear(std::cos(angle), 1e-6F)));
  EXPECT_THAT(value(asset, 1), ElementsAre(0, 0, -half, -half));
}

TEST(Keyframes, NormalizedRotationsAndSplinesHaveLengthOne) {
  Accessors accessors;
  accessors.add("SCALAR", kKeyFloat, 2, floats({0, 1}));
  accessors.add("VEC4", kKeyByte, 2, packed<std::int8_t>({0, 0, 0, 127, 0, 0, 90, 90}),
                R"(, "normalized": true)");
  const BytesAsset asset(accessors,
                         animation("LINEAR", on_node("rotation")) + R"(, "nodes": [{}])");
  EXPECT_THAT(value(asset, 1),
              ElementsAre(0, 0, FloatNear(0.70710678F, 1e-6F), FloatNear(0.70710678F, 1e-6F)));
}

TEST(Keyframes, WeightsOfAllTargetsMoveTogether) {
  Accessors accessors;
  accessors.add("SCALAR", kKeyFloat, 2, floats({0, 1}));
  accessors.add("SCALAR", kKeyFloat, 4, floats({0, 1, 1, 0.5F}));
  const BytesAsset asset(
      accessors, animation("LINEAR", on_node("weights")) + R"(, "nodes": [{"mesh": 0}], "meshes": [
 {"primitives": [{"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}, {"POSITION": 0}]}]}])");
  EXPECT_THAT(value(asset, 0.5), ElementsAre(0.5F, 0.75F));
  const auto sampled = sample(asset, 0.5);
  EXPECT_THAT(morph_weights(asset.asset(), asset.views(), 0, sampled.values),
              ElementsAre(0.5F, 0.75F));
}

TEST(Keyframes, PointersLeadToPropertiesWithDefaults) {
  Accessors accessors;
  accessors.add("SCALAR", kKeyFloat, 2, floats({0, 1}));
  accessors.add("SCALAR", kKeyUnsignedByte, 2, packed<std::uint8_t>({0, 255}),
                R"(, "normalized": true)");
  const BytesAsset asset(
      accessors,
      animation("LINEAR", on_pointer("/materials/0/pbrMetallicRoughness/metallicFactor")) +
          R"(, "materials": [{"pbrMetallicRoughness": {}}])");
  EXPECT_THAT(
      sample(asset, 0.25).values,
      ElementsAre(Pair("/materials/0/pbrMetallicRoughness/metallicFactor", ElementsAre(0.25F))));
}

TEST(Keyframes, OneWeightMayMoveByItself) {
  Accessors accessors;
  accessors.add("SCALAR", kKeyFloat, 2, floats({0, 1}));
  accessors.add("SCALAR", kKeyFloat, 2, floats({0, 1}));
  const BytesAsset asset(
      accessors, animation("LINEAR", on_pointer("/nodes/0/weights/1")) +
                     R"(, "nodes": [{"mesh": 0, "weights": [0.5, 0.5]}], "meshes": [{"primitives": [
 {"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}, {"POSITION": 0}]}]}])");
  EXPECT_THAT(morph_weights(asset.asset(), asset.views(), 0, sample(asset, 0.25).values),
              ElementsAre(0.5F, 0.25F));
}

TEST(Keyframes, ChannelsThatCannotBeUsedAreNamed) {
  const auto notes = [](const std::string& members, std::size_t values = 2) {
    Accessors accessors;
    accessors.add("SCALAR", kKeyFloat, 2, floats({0, 1}));
    accessors.add("VEC3", kKeyFloat, values, std::string(values * 12, '\0'));
    return sample(BytesAsset(accessors, members + R"(, "nodes": [{}])"), 0.5).notes;
  };
  EXPECT_THAT(notes(animation("LINEAR", on_node("translation"))), IsEmpty());
  EXPECT_THAT(notes(animation("LINEAR", on_node("rotation"))),
              ElementsAre(HasSubstr("values of another type")));
  EXPECT_THAT(notes(animation("LINEAR", on_node("wobble"))),
              ElementsAre(HasSubstr("moves nothing")));
  EXPECT_THAT(notes(animation("LINEAR", on_pointer("/nodes/7/scale"))),
              ElementsAre(HasSubstr("moves nothing")));
  EXPECT_THAT(notes(animation("CUBICSPLINE", on_node("scale"))),
              ElementsAre(HasSubstr("too few values")));
  EXPECT_THAT(notes(animation("LINEAR", on_node("scale")), 1),
              ElementsAre(HasSubstr("too few values")));
}

TEST(Keyframes, SparseKeyframesAreFound) {
  Accessors accessors;
  accessors.add("SCALAR", kKeyFloat, 3, floats({0, 1, 2}));
  const int indices = accessors.add_view(packed<std::uint8_t>({0, 2}));
  const int values = accessors.add_view(floats({1, 2, 3, 7, 8, 9}));
  accessors.add_plain(R"({"type": "VEC3", "componentType": 5126, "count": 3, "sparse": {"count": 2,
 "indices": {"componentType": 5121, "bufferView": )" +
                      std::to_string(indices) + R"(}, "values": {"bufferView": )" +
                      std::to_string(values) + "}}}");
  const BytesAsset asset(accessors, animation("LINEAR", on_node("scale")) + R"(, "nodes": [{}])");
  EXPECT_THAT(value(asset, 0), ElementsAre(1, 2, 3));
  EXPECT_THAT(value(asset, 1), ElementsAre(0, 0, 0));
  EXPECT_THAT(value(asset, 2), ElementsAre(7, 8, 9));
}

}  // namespace
}  // namespace gltfx::model
