// SPDX-License-Identifier: Apache-2.0
// Scenes whose light is known in closed form, from a .gltf on the disk to the numbers of an OpenEXR
// file.
#include <array>
#include <numbers>

#include <gtest/gtest.h>

#include "pipeline/baking.hpp"
#include "sanitized.hpp"
#include "shader/medium.hpp"
#include "shader/transfer.hpp"

namespace gltfx::test {
namespace {

using render::cube;
using render::quad;
using render::sphere;
using std::numbers::pi;

class ClosedForm : public Baking {
 protected:
  void expect_everywhere(AssetText& asset, const std::array<double, 3>& expected,
                         double tolerance) {
    const Numbers picture = bake(asset);
    ASSERT_EQ(picture.channels, 3U);
    for (std::uint32_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(picture.mean(c), expected[c], tolerance) << "colour " << c;
    }
  }
};

const Json kClear = {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}};

Json clear_volume(double ior, const Json& volume, const Json& more = Json::object()) {
  Json extensions = kClear;
  extensions["KHR_materials_volume"] = volume;
  extensions["KHR_materials_ior"] = {{"ior", ior}};
  extensions.update(more);
  return extensions;
}

// What gives back all light cannot be seen in an even light.
TEST_F(ClosedForm, AWhiteFurnaceShowsNothing) {
  surround(1);
  options.samples = 64;
  options.bounces = 64;
  for (const Json& material :
       {dielectric({1, 1, 1, 1}, 1, no_specular()),
        dielectric({1, 1, 1, 1}, 0, clear_volume(1.5, {{"thicknessFactor", 1}})),
        Json{{"pbrMetallicRoughness", {{"roughnessFactor", 0}}}},
        Json{{"extensions", {{"KHR_materials_unlit", Json::object()}}}}}) {
    AssetText asset;
    asset.draw(sphere(1, 16), material);
    asset.orthographic(1.2, 4);
    expect_everywhere(asset, {1, 1, 1}, 0.004);
  }
}

TEST_F(ClosedForm, AWhiteSurfaceNeverGivesMoreThanItGets) {
  surround(1);
  options.samples = 256;
  for (const double roughness : {0.0, 0.3, 0.6, 1.0}) {
    AssetText asset;
    asset.draw(sphere(1, 16), dielectric({1, 1, 1, 1}, roughness));
    asset.orthographic(0.95, 4);
    const Numbers picture = bake(asset);
    EXPECT_LE(picture.mean(0), 1.003) << roughness;
    EXPECT_GE(picture.mean(0), 0.9) << roughness;
  }
}

// Walls that shine and scatter: L = Le / (1 - albedo).
TEST_F(ClosedForm, AShiningBoxSeenFromInside) {
  Json wall = dielectric({0.5, 0.8, 0.2, 1}, 1, no_specular());
  wall["emissiveFactor"] = {0.4, 0.1, 1};
  wall["doubleSided"] = true;
  AssetText asset;
  asset.draw(cube(2), wall);
  asset.camera({{"type", "perspective"}, {"perspective", {{"yfov", 1.2}, {"znear", 0.01}}}},
               {{"translation", {0.3, 0.1, 0.7}}});
  options.lights = BakeLights::asset;
  options.bounces = 64;
  options.samples = 128;
  expect_everywhere(asset, {0.8, 0.5, 1.25}, 0.01);
}

// Once through the slab, and between its faces as often as they reflect:
// R + (1 - R)^2 t / (1 - R t).
TEST_F(ClosedForm, ASlabAbsorbsByBeerAndReflectsByFresnel) {
  surround(1);
  options.bounces = 32;
  options.samples = kSanitized ? 512 : 2048;
  const std::array<double, 3> color{0.9, 0.5, 0.2};
  for (const double ior : {1.0, 1.5, 2.0}) {
    AssetText asset;
    asset.draw(cube(1), dielectric({1, 1, 1, 1}, 0,
                                   clear_volume(ior, {{"thicknessFactor", 1},
                                                      {"attenuationDistance", 1.5},
                                                      {"attenuationColor", color}})));
    asset.orthographic(0.5, 4);
    const double r = std::pow((ior - 1) / (ior + 1), 2);
    std::array<double, 3> expected{};
    for (std::size_t c = 0; c < 3; ++c) {
      const double t = std::pow(color[c], 2 / 1.5);
      expected[c] = r + (1 - r) * (1 - r) * t / (1 - r * t);
    }
    expect_everywhere(asset, expected, 0.004);
  }
}

// A wall of glass around nothing, once as two closed surfaces with a medium between, once as two
// thin walls: straight on they are the same, but for what the medium absorbs.
TEST_F(ClosedForm, AHollowShellAbsorbsInItsWallAlone) {
  surround(1);
  options.bounces = 16;
  options.samples = 64;
  render::Mesh shell = sphere(1, 64);
  const render::Mesh inside = sphere(0.75F, 64);
  const auto count = static_cast<std::uint32_t>(shell.positions.size());
  for (std::size_t i = 0; i < inside.positions.size(); ++i) {
    shell.positions.push_back(inside.positions[i]);
    const Float3& n = inside.normals[i];
    shell.normals.push_back({-n[0], -n[1], -n[2]});
  }
  shell.uvs.clear();
  for (const auto& [a, b, c] : inside.triangles) {
    shell.triangles.push_back({a + count, c + count, b + count});
  }
  Json extensions = clear_volume(1, {{"thicknessFactor", 0.25},
                                     {"attenuationDistance", 0.5},
                                     {"attenuationColor", {0.8, 0.5, 0.2}}});
  extensions.update(no_specular());
  AssetText asset;
  asset.draw(shell, dielectric({1, 1, 1, 1}, 0, extensions));
  asset.orthographic(0.05, 4);
  expect_everywhere(asset, {0.8, 0.5, 0.2}, 0.003);
}

TEST_F(ClosedForm, ThinWallsAndAClearVolumeAreTheSameStraightOn) {
  surround(1);
  options.bounces = 32;
  options.samples = kSanitized ? 512 : 2048;
  for (const bool volume : {false, true}) {
    Json extensions = kClear;
    if (volume) extensions = clear_volume(1.5, {{"thicknessFactor", 1}});
    AssetText asset;
    Json material = dielectric({0.8, 0.5, 0.2, 1}, 0, extensions);
    material["doubleSided"] = true;
    asset.draw(cube(1), material);
    asset.orthographic(0.5, 4);
    const auto expected = [](double c) { return 0.04 + 0.96 * c * c; };
    expect_everywhere(asset, {expected(0.8), expected(0.5), expected(0.2)}, 0.004);
  }
}

// Deep and wide beside its free path: a half space that scatters evenly, without a surface of its
// own, under a slanted view. Two ways to say the same medium.
TEST_F(ClosedForm, ADeepMediumGivesBackWhatTransferTheorySays) {
  surround(1);
  options.samples = 256;
  const double mu = 0.6;
  const std::array<double, 3> albedo{0.5, 0.8, 0.95};
  Json sss{{"scatterDistance", 1}, {"scatterColor", Json::array()}};
  Json absorption{
      {"thicknessFactor", 1}, {"attenuationDistance", 1}, {"attenuationColor", Json::array()}};
  Json multiple{{"multiscatterColorFactor", {0.2, 0.5, 0.8}}};
  std::array<double, 3> first{};
  std::array<double, 3> second{};
  for (std::size_t c = 0; c < 3; ++c) {
    sss["scatterColor"].push_back(std::exp(-albedo[c]));
    absorption["attenuationColor"].push_back(std::exp(albedo[c] - 1));
    first[c] = shader::plane_albedo(albedo[c], mu);
    const double mapped = shader::single_scatter_albedo(multiple["multiscatterColorFactor"][c]);
    second[c] = shader::plane_albedo(mapped, mu);
  }
  const Json all{{"thicknessFactor", 1},
                 {"attenuationDistance", 1},
                 {"attenuationColor", Json(3, std::exp(-1))}};
  const auto draw = [&](const Json& volume, const char* name, const Json& scatter,
                        const std::array<double, 3>& expected) {
    Json extensions = clear_volume(1, volume, no_specular());
    extensions[name] = scatter;
    AssetText asset;
    Json place{{"translation", {0, 0, -20}}};
    asset.draw(cube(20), dielectric({1, 1, 1, 1}, 0, extensions), place);
    const double half_turn = std::acos(mu) / 2;
    asset.camera({{"type", "orthographic"},
                  {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0.01}, {"zfar", 1000}}}},
                 {{"translation", {0, -8, 6}},
                  {"rotation", {std::sin(half_turn), 0, 0, std::cos(half_turn)}}});
    expect_everywhere(asset, expected, 0.012);
  };
  draw(absorption, "KHR_materials_sss", sss, first);
  draw(all, "KHR_materials_volume_scatter", multiple, second);
}

TEST_F(ClosedForm, WhatShinesIsSeenAsItIs) {
  Json lamp = dielectric({0, 0, 0, 1}, 1,
                         {{"KHR_materials_specular", {{"specularFactor", 0}}},
                          {"KHR_materials_emissive_strength", {{"emissiveStrength", 6}}}});
  lamp["emissiveFactor"] = {0.25, 0.5, 1};
  AssetText asset;
  asset.draw(quad(), lamp);
  asset.orthographic(0.5, 2);
  expect_everywhere(asset, {1.5, 3, 6}, 1e-5);
  options.exposure = -1;
  expect_everywhere(asset, {0.75, 1.5, 3}, 1e-5);
}

// E = I cos / d^2, L = albedo E / pi, at every pixel.
TEST_F(ClosedForm, ALampOnAWallByTheSquareOfItsDistance) {
  surround(0);
  AssetText asset;
  asset.draw(quad(1), dielectric({0.9, 0.6, 0.3, 1}, 1, no_specular()));
  asset.light({{"type", "point"}, {"intensity", 0.7}, {"color", {1, 0.5, 1}}},
              {{"translation", {0.25, 0.5, 1.5}}});
  asset.orthographic(1, 4);
  const Numbers picture = bake(asset);
  for (std::uint32_t y = 1; y < 7; ++y) {
    for (std::uint32_t x = 1; x < 7; ++x) {
      const double px = (x + 0.5) / 4 - 1;
      const double py = 1 - (y + 0.5) / 4;
      const double quad = std::pow(px - 0.25, 2) + std::pow(py - 0.5, 2) + 1.5 * 1.5;
      const double lux = 0.7 * 1.5 / std::pow(quad, 1.5);
      EXPECT_NEAR(picture.at(x, y, 0), 0.9 * lux / pi, 0.003) << x << ' ' << y;
      EXPECT_NEAR(picture.at(x, y, 1), 0.3 * lux / pi, 0.001) << x << ' ' << y;
    }
  }
}

TEST_F(ClosedForm, ALeafLitFromBehind) {
  surround(0);
  Json extensions = no_specular();
  extensions["KHR_materials_diffuse_transmission"] = {
      {"diffuseTransmissionFactor", 0.6}, {"diffuseTransmissionColorFactor", {0.2, 0.8, 0.4}}};
  Json leaf = dielectric({0.9, 0.5, 0.1, 1}, 1, extensions);
  leaf["doubleSided"] = true;
  for (const bool behind : {true, false}) {
    AssetText asset;
    asset.draw(quad(1), leaf);
    // 60 degrees from the normal; without a turn it shines down -z.
    const double half_turn = behind ? pi / 3 : pi / 6;
    asset.light({{"type", "directional"}, {"intensity", 2}},
                {{"rotation", {0, std::sin(half_turn), 0, std::cos(half_turn)}}});
    asset.orthographic(0.5, 4);
    const double lux = 2 * 0.5;
    const double part = behind ? 0.6 : 0.4;
    const std::array<double, 3> color =
        behind ? std::array<double, 3>{0.2, 0.8, 0.4} : std::array<double, 3>{0.9, 0.5, 0.1};
    expect_everywhere(
        asset, {part * color[0] * lux / pi, part * color[1] * lux / pi, part * color[2] * lux / pi},
        1e-4);
  }
}

// Small squares shine where pixels are expected: with a picture that is wider than high, and with
// one that is higher than wide.
TEST_F(ClosedForm, CamerasPutPointsWhereTheyBelong) {
  surround(0);
  options.samples = 64;
  Json lamp = dielectric({0, 0, 0, 1}, 1, no_specular());
  lamp["emissiveFactor"] = {1, 1, 1};
  const double yfov = 0.8;
  for (const bool perspective : {true, false}) {
    for (const BakeSize size : {BakeSize{24, 12}, BakeSize{12, 24}}) {
      AssetText asset;
      // In the middle of the pixel in column 3 of row 9.
      const double half_height =
          perspective ? std::tan(yfov / 2) * 5 : std::max(1.5, 2.0 * size.height / size.width);
      const double half_width = half_height * size.width / size.height;
      const double x = (3.5 / size.width * 2 - 1) * half_width;
      const double y = (1 - 9.5 / size.height * 2) * half_height;
      asset.draw(quad(static_cast<float>(half_width / size.width)), lamp,
                 {{"translation", {10 + x, y, -5}}});
      if (perspective) {
        asset.camera({{"type", "perspective"}, {"perspective", {{"yfov", yfov}, {"znear", 0.01}}}},
                     {{"translation", {10, 0, 0}}, {"scale", {3, 3, 3}}});
      } else {
        asset.camera(
            {{"type", "orthographic"},
             {"orthographic", {{"xmag", 2}, {"ymag", 1.5}, {"znear", 0.01}, {"zfar", 100}}}},
            {{"translation", {10, 0, 0}}});
      }
      options.sizes = {size};
      const Numbers picture = bake(asset);
      EXPECT_GT(picture.at(3, 9), 0.4);
      EXPECT_NEAR(picture.mean(0) * size.width * size.height, 1, 0.15) << "one pixel in all";
      EXPECT_NEAR(picture.at(2, 9), picture.at(4, 9), 0.15);
      EXPECT_NEAR(picture.at(3, 8), picture.at(3, 10), 0.15);
    }
  }
}

// Khronos PBR Neutral as its text has it, then the curve of sRGB.
int shown(double radiance) {
  double value = radiance - (radiance < 0.08 ? radiance - 6.25 * radiance * radiance : 0.04);
  const double start = 0.8 - 0.04;
  if (value >= start) {
    const double room = 1 - start;
    const double peak = 1 - room * room / (value + room - start);
    value = peak;  // grey stays grey
  }
  const double encoded =
      value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
  return static_cast<int>(encoded * 255 + 0.5);
}

TEST_F(ClosedForm, BytesAreToneMappedAndEncoded) {
  for (const double radiance : {0.01, 0.05, 0.2, 0.7, 1.0, 8.0}) {
    Json lamp = dielectric({0, 0, 0, 1}, 1,
                           {{"KHR_materials_specular", {{"specularFactor", 0}}},
                            {"KHR_materials_emissive_strength", {{"emissiveStrength", radiance}}}});
    lamp["emissiveFactor"] = {1, 1, 1};
    AssetText asset;
    asset.draw(quad(), lamp);
    asset.orthographic(0.5, 2);
    for (const double stops : {0.0, 1.0}) {
      options.exposure = stops;
      const BakeReport done = report(asset);
      ASSERT_EQ(done.pixels.bytes.size(), 8U * 8 * 3) << done.error;
      EXPECT_NEAR(done.pixels.bytes[8 * 4 * 3], shown(radiance * std::exp2(stops)), 1) << radiance;
    }
  }
}

class Identity : public Baking {
 protected:
  std::vector<std::uint8_t> pixels(const Json& extensions) {
    AssetText asset;
    Json material = dielectric({0.8, 0.5, 0.3, 1}, 0.4, extensions);
    material["doubleSided"] = true;
    asset.draw(sphere(1, 12), material);
    asset.light({{"type", "directional"}, {"intensity", 2}});
    options.cameras.clear();
    const BakeReport done = report(asset);
    EXPECT_EQ(done.problem, BakeProblem::none) << done.error << first_error(done);
    return done.pixels.bytes;
  }
};

TEST_F(Identity, AFactorOf0IsTheCoreMaterial) {
  const auto core = pixels({});
  EXPECT_EQ(core, pixels({{"KHR_materials_diffuse_transmission",
                           {{"diffuseTransmissionFactor", 0},
                            {"diffuseTransmissionColorFactor", {0, 1, 0}}}}}));
  EXPECT_EQ(core, pixels({{"KHR_materials_translucency", {{"translucencyFactor", 0}}}}));
  EXPECT_EQ(core, pixels({{"KHR_materials_transmission", {{"transmissionFactor", 0}}}}));
  EXPECT_EQ(core, pixels({{"KHR_materials_clearcoat", {{"clearcoatFactor", 0}}},
                          {"KHR_materials_sheen", {{"sheenRoughnessFactor", 0.5}}},
                          {"KHR_materials_iridescence", {{"iridescenceFactor", 0}}}}));
  EXPECT_NE(core,
            pixels({{"KHR_materials_diffuse_transmission", {{"diffuseTransmissionFactor", 0.1}}}}));
}

TEST_F(Identity, TransmissionOf1HidesDiffuseTransmission) {
  Json both = kClear;
  both["KHR_materials_diffuse_transmission"] = {{"diffuseTransmissionFactor", 0.7},
                                                {"diffuseTransmissionColorFactor", {0, 1, 0}}};
  EXPECT_EQ(pixels(kClear), pixels(both));
  both["KHR_materials_transmission"]["transmissionFactor"] = 0.9;
  Json one = both;
  one.erase("KHR_materials_diffuse_transmission");
  EXPECT_NE(pixels(one), pixels(both));
}

}  // namespace
}  // namespace gltfx::test
