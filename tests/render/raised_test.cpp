// SPDX-License-Identifier: Apache-2.0
/// A bump that a normal map draws on a mirror beside the same bump in geometry.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "render/surface.hpp"
#include "rendering.hpp"

namespace gltfx::render {
namespace {

constexpr double kRadius = 0.8;
constexpr double kHeight = 0.065;  // slopes of 7 degrees at most

double height(double x, double y) {
  const double r = std::hypot(x, y);
  return r < kRadius ? kHeight * (0.5 + 0.5 * std::cos(std::numbers::pi * r / kRadius)) : 0;
}

Vec3d bump_normal(double x, double y) {
  const double r = std::hypot(x, y);
  if (r >= kRadius || r == 0) return {0, 0, 1};
  const double slope =
      -kHeight * 0.5 * std::numbers::pi / kRadius * std::sin(std::numbers::pi * r / kRadius);
  return normalize({-slope * x / r, -slope * y / r, 1});
}

SceneMaterial gold(double roughness) {
  SceneMaterial material;
  material.factors.base_color = {0.95, 0.9, 0.8};
  material.factors.roughness = roughness;
  return material;
}

Scene mapped(double roughness) {
  constexpr std::uint32_t kTexels = 512;
  auto texels = std::make_shared<std::vector<std::uint16_t>>();
  for (std::uint32_t row = 0; row < kTexels; ++row) {
    for (std::uint32_t column = 0; column < kTexels; ++column) {
      const Vec3d n = bump_normal(2 * (column + 0.5) / kTexels - 1, 1 - 2 * (row + 0.5) / kTexels);
      for (const double part : {n.x, n.y, n.z})
        texels->push_back(static_cast<std::uint16_t>(std::lround((part + 1) / 2 * 65535)));
    }
  }
  Texture texture;
  texture.width = texture.height = kTexels;
  texture.channels = 3;
  texture.bits = 16;
  texture.pixels = std::as_bytes(std::span(*texels));
  texture.owner = texels;
  SceneMaterial material = gold(roughness);
  material.use(Slot::normal).texture = 0;
  Scene scene = scene_of(quad(), material);
  scene.textures.push_back(texture);
  return scene;
}

Scene modelled(double roughness) {
  constexpr std::uint32_t kSteps = 256;
  Mesh mesh;
  for (std::uint32_t row = 0; row <= kSteps; ++row) {
    for (std::uint32_t column = 0; column <= kSteps; ++column) {
      const double x = 2.0 * column / kSteps - 1;
      const double y = 2.0 * row / kSteps - 1;
      const Vec3d n = bump_normal(x, y);
      mesh.positions.push_back(
          {static_cast<float>(x), static_cast<float>(y), static_cast<float>(height(x, y))});
      mesh.normals.push_back(
          {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
      if (row == kSteps || column == kSteps) continue;
      const std::uint32_t at = row * (kSteps + 1) + column;
      mesh.triangles.push_back({at, at + 1, at + kSteps + 2});
      mesh.triangles.push_back({at, at + kSteps + 2, at + kSteps + 1});
    }
  }
  return scene_of(std::move(mesh), gold(roughness));
}

constexpr int kRegions = 6;
using Picture = std::array<double, kRegions * kRegions>;

// The mean of each region, from so many degrees off the normal.
Picture seen(Scene scene, double tilt, ShaderMode mode) {
  Stage stage(std::move(scene));
  stage.world.environment.emplace(even_light());
  stage.mode = mode;
  const double angle = tilt * std::numbers::pi / 180;
  const Vec3d towards(0, -std::sin(angle), std::cos(angle));
  constexpr int kSide = 8;  // rays of a region
  Picture means{};
  for (int i = 0; i < kRegions * kSide; ++i) {
    for (int j = 0; j < kRegions * kSide; ++j) {
      const Vec3d target(2 * (i + 0.5) / (kRegions * kSide) - 1,
                         2 * (j + 0.5) / (kRegions * kSide) - 1, 0);
      const Estimate light = stage.path({target + towards * 10, -towards}, 4);
      EXPECT_LE(max_value(light.mean), 1.0001);
      means[static_cast<std::size_t>(i / kSide * kRegions + j / kSide)] +=
          light.mean.y / (kSide * kSide);
    }
  }
  return means;
}

double furthest(const Picture& a, const Picture& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::fabs(a[i] / b[i] - 1));
  return most;
}

TEST(RaisedReflections, AMappedBumpIsAsBrightAsAModelledOne) {
  for (const double tilt : {0.0, 45.0, 70.0, 80.0}) {
    const Picture geometry = seen(modelled(0), tilt, ShaderMode::conserving);
    EXPECT_LT(furthest(seen(mapped(0), tilt, ShaderMode::conserving), geometry), 0.05) << tilt;
  }
}

TEST(RaisedReflections, TheTextHasABlackRing) {
  const Picture geometry = seen(modelled(0), 80, ShaderMode::spec);
  EXPECT_GT(furthest(seen(mapped(0), 80, ShaderMode::spec), geometry), 0.2);
}

TEST(RaisedReflections, NormalsOfOtherSurfacesStay) {
  const Scene scene = mapped(0.3);
  const auto bvh = Bvh::build(scene);
  ASSERT_TRUE(bvh);
  const Ray ray{{0.4, 0.1, 5}, {0, 0, -1}};
  const auto hit = bvh->intersect(ray, 0, Backs::solid);
  ASSERT_TRUE(hit);
  const Surface surface = surface_at(scene, *hit, ray);
  Surface raised = surface;
  raise_reflections(raised, -ray.direction);
  EXPECT_EQ(raised.frame.normal, surface.frame.normal);
  EXPECT_EQ(raised.frame.tangent, surface.frame.tangent);
}

}  // namespace
}  // namespace gltfx::render
