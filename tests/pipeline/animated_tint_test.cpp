// SPDX-License-Identifier: Apache-2.0
// An animated base colour tints the light that passes through a first-generation material. After an
// upgrade it still does.
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "pipeline/tint_support.hpp"

namespace gltfx::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kBaseColor = "/materials/0/pbrMetallicRoughness/baseColorFactor";
const std::string kTint =
    "/materials/0/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionColorFactor";

std::string pointer_of(const Json& channel) {
  return channel["target"]["extensions"]["KHR_animation_pointer"]["pointer"];
}

TEST(AnimatedTint, TheCopyGetsAChannelWithCutValues) {
  Scene scene;
  scene.add_primitive();
  const std::size_t output =
      scene.add_accessor(bytes_of<float>({1, .5F, 0, 1, 0, .25F, 1, .5F}), kFloat, "VEC4", 2);
  scene.animate(kBaseColor, output);
  scene.animate(kBaseColor, output, "STEP", 1);
  const Upgraded result = upgraded(scene);
  EXPECT_EQ(result.action().outcome, UpgradeOutcome::safe);
  std::vector<std::size_t> cuts;
  for (std::size_t i = 0; i < 2; ++i) {
    const Json& animation = result.json["animations"][i];
    ASSERT_EQ(animation["channels"].size(), 2U);
    ASSERT_EQ(animation["samplers"].size(), 2U);
    EXPECT_EQ(pointer_of(animation["channels"][0]), kBaseColor);
    EXPECT_EQ(animation["channels"][0]["sampler"], 0);
    EXPECT_EQ(pointer_of(animation["channels"][1]), kTint);
    EXPECT_EQ(animation["channels"][1]["sampler"], 1);
    EXPECT_EQ(animation["samplers"][1]["interpolation"], i == 0 ? "LINEAR" : "STEP");
    EXPECT_EQ(animation["samplers"][1]["input"], animation["samplers"][0]["input"]);
    cuts.push_back(animation["samplers"][1]["output"]);
  }
  EXPECT_EQ(cuts[0], cuts[1]);
  EXPECT_EQ(result.json["accessors"][cuts[0]]["type"], "VEC3");
  EXPECT_THAT(numbers_of(result.text, cuts[0]), ElementsAre(1, .5, 0, 0, .25, 1));
}

TEST(AnimatedTint, TangentsAreCutToo) {
  Scene scene;
  scene.add_primitive();
  std::vector<float> values;
  for (int i = 0; i < 24; ++i) values.push_back(static_cast<float>(i) / 32);
  scene.animate(kBaseColor, scene.add_accessor(bytes_of(values), kFloat, "VEC4", 6), "CUBICSPLINE");
  const Upgraded result = upgraded(scene);
  const std::size_t cut = result.json["animations"][0]["samplers"][1]["output"];
  EXPECT_EQ(result.json["accessors"][cut]["count"], 6);
  std::vector<double> expected;
  for (int i = 0; i < 24; ++i) {
    if (i % 4 != 3) expected.push_back(i / 32.0);
  }
  EXPECT_EQ(numbers_of(result.text, cut), expected);
}

TEST(AnimatedTint, NormalizedValuesKeepTheirType) {
  Scene scene;
  scene.add_primitive();
  scene.animate(kBaseColor,
                scene.add_accessor(bytes_of<std::uint8_t>({255, 51, 0, 9, 0, 102, 255, 9}), kByte,
                                   "VEC4", 2));
  const Upgraded result = upgraded(scene);
  const std::size_t cut = result.json["animations"][0]["samplers"][1]["output"];
  EXPECT_EQ(result.json["accessors"][cut]["componentType"], kByte);
  EXPECT_EQ(result.json["accessors"][cut]["normalized"], true);
  EXPECT_THAT(numbers_of(result.text, cut), ElementsAre(1, .2, 0, 0, .4, 1));
}

TEST(AnimatedTint, VertexColoursMultiplyTheKeyframes) {
  Scene scene;
  scene.add_uniform(51, 255, 0);
  scene.animate(kBaseColor,
                scene.add_accessor(bytes_of<std::uint8_t>({255, 51, 0, 9, 0, 102, 255, 9}), kByte,
                                   "VEC4", 2));
  const Upgraded result = upgraded(scene);
  EXPECT_EQ(result.extension()["diffuseTransmissionColorFactor"], Json({0.1, 0.25, 0}));
  const std::size_t cut = result.json["animations"][0]["samplers"][1]["output"];
  EXPECT_THAT(numbers_of(result.text, cut),
              ElementsAre(testing::DoubleNear(.2, 1e-7), testing::DoubleNear(.2, 1e-7), 0, 0,
                          testing::DoubleNear(.4, 1e-7), 0));
}

TEST(AnimatedTint, TransformsOfTheTextureMoveItsCopyByTheSameSampler) {
  Scene scene;
  scene.add_primitive();
  scene.json()["extensionsUsed"].push_back("KHR_texture_transform");
  scene.json()["images"] = {{{"uri",
                              "data:image/png;base64,"
                              "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGP6"
                              "DwABBQECz6AuzQAAAABJRU5ErkJggg=="}}};
  scene.json()["textures"] = {{{"source", 0}}};
  scene.json()["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {
      {"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {0, 0}}}}}}};
  scene.primitive(0)["attributes"]["TEXCOORD_0"] =
      scene.add_accessor(bytes_of<float>({0, 0, 1, 0, 0, 1}), kFloat, "VEC2", 3);
  const std::string inside = "/extensions/KHR_texture_transform/offset";
  scene.animate("/materials/0/pbrMetallicRoughness/baseColorTexture" + inside,
                scene.add_accessor(bytes_of<float>({0, 0, 1, 1}), kFloat, "VEC2", 2));
  const Upgraded result = upgraded(scene);
  EXPECT_EQ(result.action().outcome, UpgradeOutcome::safe);
  const Json& animation = result.json["animations"][0];
  EXPECT_EQ(animation["samplers"].size(), 1U);
  ASSERT_EQ(animation["channels"].size(), 2U);
  EXPECT_EQ(animation["channels"][1]["sampler"], 0);
  EXPECT_EQ(pointer_of(animation["channels"][1]),
            "/materials/0/extensions/KHR_materials_diffuse_transmission/"
            "diffuseTransmissionColorTexture" +
                inside);
}

TEST(AnimatedTint, WhatIsNoChannelCannotBeFollowed) {
  Scene scene;
  scene.add_primitive();
  scene.json()["extensionsUsed"].push_back("KHR_interactivity");
  scene.json()["extensions"]["KHR_interactivity"]["graphs"] = {
      {{"nodes", {{{"configuration", {{"pointer", {{"value", {kBaseColor}}}}}}}}}}};
  const Upgraded result = upgraded(scene);
  EXPECT_EQ(result.action().outcome, UpgradeOutcome::unsafe);
  EXPECT_THAT(result.action().notes,
              Contains(HasSubstr("something other than an animation channel")));
}

TEST(AnimatedTint, KeyframesThatCannotBeReadAreALoss) {
  Scene scene;
  scene.add_primitive();
  const std::size_t output =
      scene.add_accessor(bytes_of<float>({1, .5F, 0, 1, 0, .25F, 1, .5F}), kFloat, "VEC4", 2);
  scene.animate(kBaseColor, output);
  for (const char* member : {"bufferView", "type"}) {
    Scene spoiled = scene;
    spoiled.json()["accessors"][output].erase(member);
    EXPECT_THAT(upgraded(spoiled).action().notes, Contains(HasSubstr("keyframes cannot be read")));
  }
}

}  // namespace
}  // namespace gltfx::test
