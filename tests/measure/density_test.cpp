// SPDX-License-Identifier: Apache-2.0
// Texels per metre, by construction.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "measure/taken.hpp"
#include "measure/uv_asset.hpp"
#include "measure/weighted_values.hpp"

namespace gltfx {
namespace {

using test::operator+;
using test::quad;
using test::Taken;
using test::UvAsset;
using testing::DoubleNear;
using testing::HasSubstr;

constexpr double kExact = 1e-4;  // positions and matrices are of single precision

// A square of one metre with the texture once.
UvAsset square(std::uint32_t width, std::uint32_t height) {
  return UvAsset().texture(width, height).add(quad(0, 0, 1, 1));
}

TEST(TexelDensity, IsTheSquareRootOfTexelsBySquareMetres) {
  EXPECT_THAT(Taken(square(64, 64).text()).number("texel-density"), DoubleNear(64, kExact));
  EXPECT_THAT(Taken(square(256, 64).text()).number("texel-density"), DoubleNear(128, kExact));
}

TEST(TexelDensity, DependsOnTheScaleOfTheNodeAndNotOnTurns) {
  const auto density = [](const UvAsset::Json& node) {
    return Taken(square(64, 64).node(node).text()).number("texel-density");
  };
  EXPECT_THAT(density({{"scale", {2, 2, 2}}}), DoubleNear(32, kExact));
  EXPECT_THAT(density({{"scale", {4, 1, 1}}}), DoubleNear(32, kExact));
  EXPECT_THAT(density({{"scale", {1, 1, 4}}}), DoubleNear(64, kExact));
  EXPECT_THAT(density({{"rotation", {0.5, 0.5, 0.5, 0.5}}, {"translation", {9, 9, 9}}}),
              DoubleNear(64, kExact));
}

TEST(TexelDensity, OfCopiesIsThatOfEachWithAPlace) {
  UvAsset asset = square(64, 64);
  const float nan = std::nanf("");
  asset.node(
      {{"extensions",
        {{"EXT_mesh_gpu_instancing",
          {{"attributes",
            {{"SCALE", asset.made.accessor("VEC3", 5126, 3,
                                           test::floats({1, 1, 1, nan, 1, 1, 2, 2, 2}))}}}}}}}});
  EXPECT_THAT(Taken(asset.text()).number("texel-density-max"), DoubleNear(64, kExact));
  EXPECT_THAT(Taken(asset.text()).number("texel-density-min"), DoubleNear(32, kExact));
}

TEST(TexelDensity, OfMovedVerticesIsThatOfEachCopy) {
  UvAsset asset = square(64, 64);
  const auto still = asset.made.accessor("VEC3", 5126, 6, std::string(72, '\0'));
  asset.made.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", still}}};
  const auto scales = asset.made.accessor("VEC3", 5126, 2, test::floats({1, 1, 1, 2, 2, 2}));
  asset.node({{"weights", {1}}});
  asset.made.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] =
      scales;
  EXPECT_THAT(Taken(asset.text()).number("texel-density-min"), DoubleNear(32, kExact));
}

TEST(TexelDensity, DependsOnTheTransformOfTheTexture) {
  UvAsset asset = square(64, 64);
  asset.made.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
      {"KHR_texture_transform", {{"scale", {2, -2}}, {"rotation", 1}, {"offset", {0.25, 0}}}}};
  EXPECT_THAT(Taken(asset.text()).number("texel-density"), DoubleNear(128, kExact));
}

TEST(TexelDensity, OfTrianglesAndOfSharesOfTheArea) {
  UvAsset asset = square(64, 64);
  asset.add(quad(0, 0, 1, 1), 0, 10).add(quad(0, 0, 1, 1), 0, 0.125F);
  const Taken values(asset.text());
  EXPECT_THAT(values.number("texel-density-min"), DoubleNear(6.4, kExact));
  EXPECT_THAT(values.number("texel-density-low"), DoubleNear(6.4, kExact));
  EXPECT_THAT(values.number("texel-density-high"), DoubleNear(6.4, kExact)) << "99 % of the area";
  EXPECT_THAT(values.number("texel-density-max"), DoubleNear(512, kExact));
  EXPECT_THAT(values.of_asset("texel-density-max"), DoubleNear(512, kExact));
}

TEST(TexelDensity, CountsWhatTheSceneDraws) {
  UvAsset asset = square(64, 64);
  asset.made.add("meshes", asset.made.json["meshes"][0]);
  asset.made.add("nodes", {{"mesh", 1}, {"scale", {9, 9, 9}}});
  EXPECT_THAT(Taken(asset.text()).number("texel-density-min"), DoubleNear(64, kExact));
  asset.made.json["scenes"][0]["nodes"] = {0, 1};
  EXPECT_THAT(Taken(asset.text()).number("texel-density-min"), DoubleNear(64.0 / 9, kExact));
  asset.made.json["scenes"][0] = {{"name", "empty"}};
  EXPECT_THAT(Taken(asset.text()).reason("texel-density").text, HasSubstr("draws no triangle"));
}

TEST(TexelDensity, CountsCopies) {
  UvAsset asset = square(64, 64);
  const auto scales =
      asset.made.accessor("VEC3", 5126, 3, test::floats({1, 1, 1, 2, 2, 2, 3, 3, 3}));
  asset.node(
      {{"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"SCALE", scales}}}}}}}});
  const Taken values(asset.text());
  EXPECT_THAT(values.number("texel-density"), DoubleNear(64 * std::sqrt(3 / 14.0), kExact));
  EXPECT_THAT(values.number("texel-density-min"), DoubleNear(64.0 / 3, kExact));
  EXPECT_THAT(values.number("texel-density-max"), DoubleNear(64, kExact));
}

TEST(TexelDensity, CountsMorphTargetsByTheirWeights) {
  UvAsset asset = square(64, 64);
  auto& primitive = asset.made.json["meshes"][0]["primitives"][0];
  primitive["targets"][0]["POSITION"] = primitive["attributes"]["POSITION"];
  EXPECT_THAT(Taken(asset.text()).number("texel-density"), DoubleNear(64, kExact));
  asset.node({{"weights", {1}}});
  EXPECT_THAT(Taken(asset.text()).number("texel-density"), DoubleNear(32, kExact));
}

TEST(TexelDensity, OfAnotherTexture) {
  UvAsset asset = square(64, 64);
  asset.texture(128, 128);
  asset.made.json["materials"][0]["normalTexture"]["index"] = 1;
  measure::Request request;
  request.parameters.density_slot = "normalTexture";
  EXPECT_THAT(Taken(asset.text(), request).number("texel-density"), DoubleNear(128, kExact));
  EXPECT_THAT(Taken(asset.text(), request).reason("texel-density", 1).text,
              HasSubstr("no such texture"));
}

TEST(TexelDensity, WithoutHeaderOrSceneThereIsNoValue) {
  UvAsset unread;
  unread.texture("no image").add(quad(0, 0, 1, 1));
  EXPECT_TRUE(Taken(unread.text()).reason("texel-density").fault);
  UvAsset asset = square(64, 64);
  asset.made.json.erase("scenes");
  const Taken values(asset.text());
  EXPECT_THAT(values.reason("texel-density").text, HasSubstr("no scene"));
}

TEST(WeightedValues, SharesAreByWeight) {
  measure::WeightedValues values;
  values.add(3, 90);
  values.add(1, 6);
  values.add(9, 4);
  EXPECT_EQ(values.value_at(0.05), 1);
  EXPECT_EQ(values.value_at(0.07), 3);
  EXPECT_EQ(values.value_at(0.95), 3);
  EXPECT_EQ(values.value_at(0.97), 9);
}

TEST(WeightedValues, AreCloseAlsoForMoreThanAreKept) {
  measure::WeightedValues values;
  constexpr int kCount = 1'100'000;
  for (int i = 0; i < kCount; ++i) values.add(1 + i / double{kCount}, 1);
  EXPECT_NEAR(values.value_at(0.05), 1.05, 0.002);
  EXPECT_NEAR(values.value_at(0.95), 1.95, 0.002);
}

}  // namespace
}  // namespace gltfx
