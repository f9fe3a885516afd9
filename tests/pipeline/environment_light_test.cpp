// SPDX-License-Identifier: Apache-2.0
// The environment light of a scene (EXT_lights_image_based): from cube maps and coefficients to the
// light that falls on surfaces.
#include <array>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/support/png_encoder.hpp"
#include "pipeline/baking.hpp"
#include "pipeline/scene_asset.hpp"
#include "preview/lighting.hpp"
#include "render/environment.hpp"

namespace gltfx::test {
namespace {

using render::quad;
using render::sphere;
using std::numbers::pi;
using namespace std::literals;
using testing::Contains;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kFaceSize = 2;

// A face of one color, as a data URI.
std::string face_uri(PngColor color, std::string_view texel) {
  std::string texels;
  for (int i = 0; i < kFaceSize * kFaceSize; ++i) texels += texel;
  const std::string png = encode_png({kFaceSize, kFaceSize, color, 8, texels, {}});
  return "data:image/png;base64," + base64(png);
}

// Irradiance by the normal that is the same everywhere.
Json even_irradiance(double irradiance) {
  Json coefficients;
  for (int i = 0; i < 9; ++i) coefficients.push_back({0.0, 0.0, 0.0});
  coefficients[0] = Json(std::array<double, 3>{irradiance, irradiance, irradiance});
  for (Json& value : coefficients[0]) value = value.get<double>() / 0.282095;
  return coefficients;
}

// Gives the asset a light with such faces: +X, -X, +Y, -Y, +Z, -Z.
Json& add_environment(AssetText& asset, const std::array<std::string, 6>& faces,
                      double irradiance) {
  asset.uses("EXT_lights_image_based");
  Json images;
  for (const std::string& uri : faces) images.push_back(asset.add("images", {{"uri", uri}}));
  asset.json()["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
  Json& lights = asset.json()["extensions"]["EXT_lights_image_based"]["lights"];
  lights.push_back({{"specularImageSize", kFaceSize},
                    {"specularImages", Json::array({images})},
                    {"irradianceCoefficients", even_irradiance(irradiance)}});
  return lights[0];
}

std::array<std::string, 6> even_faces(const std::string& uri) {
  return {uri, uri, uri, uri, uri, uri};
}

// Red, green, blue and their opposites: cyan, magenta, yellow.
std::array<std::string, 6> colored_faces() {
  const auto face = [](std::string_view texel) { return face_uri(PngColor::rgb, texel); };
  return {face("\xFF\0\0"sv),   face("\0\xFF\xFF"sv), face("\0\xFF\0"sv),
          face("\xFF\0\xFF"sv), face("\0\0\xFF"sv),   face("\xFF\xFF\0"sv)};
}

auto of_color(float r, float g, float b) {
  return ElementsAre(FloatNear(r, 1e-3F), FloatNear(g, 1e-3F), FloatNear(b, 1e-3F));
}

class EnvironmentLight : public Baking {
 protected:
  static render::Scene scene(AssetText& asset) {
    if (!asset.json().contains("nodes")) asset.draw(quad(1), plastic());
    return scene_of_text(asset.text());
  }
  static Float3 seen(const render::Scene& scene, const Vec3d& direction) {
    const auto radiance = render::Environment(*scene.environment).radiance(direction);
    return {static_cast<float>(radiance.x), static_cast<float>(radiance.y),
            static_cast<float>(radiance.z)};
  }
};

TEST_F(EnvironmentLight, FacesLieWhereTheyAreNamedFor) {
  AssetText asset;
  add_environment(asset, colored_faces(), pi / 2);
  const render::Scene drawn = scene(asset);
  ASSERT_TRUE(drawn.environment);
  EXPECT_THAT(drawn.notes, IsEmpty());
  EXPECT_THAT(seen(drawn, {1, 0, 0}), of_color(1, 0, 0));
  EXPECT_THAT(seen(drawn, {-1, 0, 0}), of_color(0, 1, 1));
  EXPECT_THAT(seen(drawn, {0, 1, 0}), of_color(0, 1, 0));
  EXPECT_THAT(seen(drawn, {0, -1, 0}), of_color(1, 0, 1));
  EXPECT_THAT(seen(drawn, {0, 0, 1}), of_color(0, 0, 1));
  EXPECT_THAT(seen(drawn, {0, 0, -1}), of_color(1, 1, 0));
}

// Seen from inside, up is up, and right of -Z, which is ahead, is +X.
TEST_F(EnvironmentLight, FacesAreSeenFromInside) {
  AssetText asset;
  std::array<std::string, 6> faces = even_faces(face_uri(PngColor::rgb, std::string(3, '\0')));
  const std::string corner = "\xFF\xFF\xFF"s + std::string(9, '\0');  // the upper left texel
  const std::string png = encode_png({kFaceSize, kFaceSize, PngColor::rgb, 8, corner, {}});
  faces[5] = "data:image/png;base64," + base64(png);
  faces[2] = faces[5];
  add_environment(asset, faces, 1);
  const render::Scene drawn = scene(asset);
  EXPECT_GT(seen(drawn, {-0.5, 0.5, -1})[0], 0.9F);
  EXPECT_LT(seen(drawn, {0.5, 0.5, -1})[0], 0.1F);
  EXPECT_LT(seen(drawn, {-0.5, -0.5, -1})[0], 0.1F);
  // Above, the upper edge is that of -Z, and +X is on the left.
  EXPECT_GT(seen(drawn, {0.5, 1, -0.5})[0], 0.9F);
  EXPECT_LT(seen(drawn, {-0.5, 1, -0.5})[0], 0.1F);
}

TEST_F(EnvironmentLight, TheRotationTurnsIt) {
  AssetText asset;
  // A quarter about +Y brings +X to -Z.
  add_environment(asset, colored_faces(), pi / 2)["rotation"] = {0, std::sqrt(0.5), 0,
                                                                 std::sqrt(0.5)};
  const render::Scene drawn = scene(asset);
  EXPECT_THAT(seen(drawn, {0, 0, -1}), of_color(1, 0, 0));
  EXPECT_THAT(seen(drawn, {1, 0, 0}), of_color(0, 0, 1));
  EXPECT_THAT(seen(drawn, {0, 1, 0}), of_color(0, 1, 0));
}

TEST_F(EnvironmentLight, AlphaDividesTheColorsOfPng) {
  AssetText asset;
  add_environment(asset, even_faces(face_uri(PngColor::rgba, "\xFF\x80\0\x33"sv)), 7)["intensity"] =
      2;
  const render::Scene drawn = scene(asset);
  // 128 of 255 is 0.2158 in linear light; alpha is 51 of 255.
  EXPECT_THAT(seen(drawn, {0.6, 0.8, 0}), of_color(10, 2.158F, 0));
}

TEST_F(EnvironmentLight, WithoutItsImagesTheCoefficientsShine) {
  AssetText asset;
  Json& light = add_environment(asset, even_faces("away.png"), 0);
  // Irradiance pi everywhere, and as much more where the normal is up: radiance 1 + 1.5 y.
  light["irradianceCoefficients"] = even_irradiance(pi);
  const double up = pi / 0.488603;
  light["irradianceCoefficients"][1] = Json(std::array<double, 3>{up, up, up});
  const render::Scene drawn = scene(asset);
  ASSERT_TRUE(drawn.environment);
  EXPECT_THAT(drawn.notes, Contains(HasSubstr("drawn by its irradiance alone")));
  EXPECT_NEAR(seen(drawn, {1, 0, 0})[0], 1, 0.05);
  EXPECT_NEAR(seen(drawn, {0, 1, 0})[0], 2.5, 0.05);
  EXPECT_NEAR(preview::irradiance(*drawn.environment, {1, 0, 0}).x, pi, 0.1);
}

TEST_F(EnvironmentLight, ImagesAndCoefficientsThatDisagreeAreNoted) {
  AssetText asset;
  add_environment(asset, even_faces(face_uri(PngColor::rgb, "\xFF\xFF\xFF")), 3 * pi);
  EXPECT_THAT(scene(asset).notes, ElementsAre(HasSubstr("3.00 times")));
}

// A convex diffuse surface in an even light shows its albedo, times that light.
TEST_F(EnvironmentLight, AnEvenOneIsAFurnace) {
  options.samples = 64;
  const auto mean = [&](const Json& material, BakeLights lights) {
    AssetText asset;
    add_environment(asset, even_faces(face_uri(PngColor::rgba, "\xFF\xFF\xFF\x33")),
                    5 * pi)["intensity"] = 0.4;  // radiance 2
    asset.draw(sphere(1, 16), material);
    asset.orthographic(0.6, 4);
    options.lights = lights;
    return bake(asset).mean(0);
  };
  EXPECT_NEAR(mean(dielectric({1, 1, 1, 1}, 1, no_specular()), BakeLights::both), 2, 0.01);
  EXPECT_NEAR(mean(dielectric({0.5, 0.5, 0.5, 1}, 1, no_specular()), BakeLights::both), 1, 0.01);
  EXPECT_NEAR(mean(dielectric({0.5, 0.5, 0.5, 1}, 1, no_specular()), BakeLights::asset), 1, 0.01);
  EXPECT_LT(mean(dielectric({0.5, 0.5, 0.5, 1}, 1, no_specular()), BakeLights::studio), 0.9);
}

}  // namespace
}  // namespace gltfx::test
