// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>

#include <gtest/gtest.h>

#include "render/light.hpp"
#include "rendering.hpp"

namespace gltfx::render {
namespace {

SceneMaterial shining(const Rgb& color) {
  SceneMaterial material = matte(Rgb(0));
  material.factors.emissive = color;
  return material;
}

// A floor, and a square lamp of half the size above it.
Scene lamp_above(bool towards_the_floor, const SceneMaterial& lamp) {
  Scene scene = scene_of(quad(20), matte(Rgb(0.5)));
  Mesh above = quad(0.5F);
  if (towards_the_floor) {
    for (auto& triangle : above.triangles) std::swap(triangle[1], triangle[2]);
  }
  above.normals.clear();
  above.material = 1;
  scene.meshes.push_back(above);
  scene.materials.push_back(lamp);
  scene.instances.push_back({1, moved(0.2F, 0.1F, 1)});
  return scene;
}

const Ray kOntoTheFloor{{2, 0, 0.9}, normalize(Vec3d(-2, 0, -0.9))};

TEST(Emitters, NothingShinesUnlessAMaterialDoes) {
  EXPECT_TRUE(Emitters().empty());
  EXPECT_TRUE(Emitters(scene_of(cube(), matte(Rgb(0.5)))).empty());
  EXPECT_FALSE(Emitters(scene_of(cube(), shining({0, 0.1, 0}))).empty());
  SceneMaterial unlit = shining(Rgb(1));
  unlit.factors.unlit = true;
  EXPECT_TRUE(Emitters(scene_of(cube(), unlit)).empty());
}

TEST(Emitters, DimSurfacesAreLeftToPaths) {
  const Scene scene = lamp_above(true, shining(Rgb(2)));
  EXPECT_TRUE(Emitters(scene, 2).empty());
  EXPECT_FALSE(Emitters(scene, 1.9).empty());
}

// Both triangles of a lamp have a texel of their own.
TEST(Emitters, TrianglesAreDimByTheirTexture) {
  static constexpr std::array<std::byte, 6> kTexels{std::byte{80},  std::byte{80},  std::byte{80},
                                                    std::byte{255}, std::byte{255}, std::byte{255}};
  Scene scene = scene_of(quad(), shining(Rgb(4)));
  Texture texture;
  texture.width = 2;
  texture.height = 1;
  texture.channels = 3;
  texture.pixels = kTexels;
  scene.textures = {texture};
  scene.materials[0].use(Slot::emissive).texture = 0;
  Mesh& mesh = scene.meshes[0];
  mesh.normals.clear();
  for (const std::size_t i : {0U, 2U}) mesh.positions.push_back(mesh.positions[i]);
  mesh.triangles[1] = {4, 5, 3};
  mesh.uvs = {{{0.25F, 0}, {0.25F, 0}, {0.25F, 0}, {0.75F, 0}, {0.75F, 0}, {0.75F, 0}}};
  const Hit dim{1, 0, 0, 0, 0, 0};
  const Hit bright{1, 0, 0, 1, 0, 0};
  EXPECT_GT(Emitters(scene).pdf(dim, 1), 0);
  EXPECT_EQ(Emitters(scene, 1).pdf(dim, 1), 0);
  EXPECT_GT(Emitters(scene, 1).pdf(bright, 1), Emitters(scene).pdf(bright, 1));
}

TEST(Emitters, LookingForThemChangesNoMean) {
  for (const bool towards : {true, false}) {
    for (const bool both_sides : {true, false}) {
      SceneMaterial lamp = shining({1, 2, 4});
      lamp.double_sided = both_sides;
      Stage stage(lamp_above(towards, lamp));
      stage.bounces = 2;
      const Estimate chance = stage.path(kOntoTheFloor, 20000);
      stage.find_emitters();
      const Estimate found = stage.path(kOntoTheFloor, 4000);
      EXPECT_EQ(found.mean.y > 0, towards || both_sides);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(found.mean[c], chance.mean[c], 3.5 * (found.error[c] + chance.error[c]) + 1e-6);
        EXPECT_LE(found.error[c], chance.error[c] * 0.5);
      }
    }
  }
}

TEST(Emitters, AlphaTakesAwayLight) {
  SceneMaterial lamp = shining(Rgb(2));
  lamp.alpha_mode = AlphaMode::blend;
  lamp.alpha = 0.25F;
  Stage faint(lamp_above(true, lamp));
  faint.find_emitters();
  lamp.alpha = 1;
  Stage full(lamp_above(true, lamp));
  full.find_emitters();
  const Estimate part = faint.path(kOntoTheFloor);
  const Estimate whole = full.path(kOntoTheFloor);
  EXPECT_NEAR(part.mean.y, whole.mean.y * 0.25, 4 * (part.error.y + whole.error.y));
}

// All directions from the middle of a box lead to one of its walls.
TEST(Emitters, DensitiesBelongToSamples) {
  SceneMaterial wall = shining({1, 1, 1});
  wall.double_sided = true;
  const Scene scene = scene_of(cube(), wall);
  const Emitters emitters(scene);
  const Vec3d from(0.3, -0.2, 0.1);
  double sum = 0;
  constexpr std::uint32_t kCount = 4096;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const EmissiveTriangle shine = emitters.sample(scene, from, SampleStream(0, 0, i).pair(0));
    ASSERT_GT(shine.pdf, 0);
    EXPECT_LT(dot(shine.normal, shine.direction), 0);
    EXPECT_NEAR(length(shine.normal), 1, 1e-6);
    EXPECT_EQ(shine.radiance, Rgb(1));
    sum += 1 / shine.pdf;
  }
  EXPECT_NEAR(sum / kCount, 4 * std::numbers::pi, 0.05);
}

TEST(Emitters, ManyTrianglesOfManyInstances) {
  Scene scene = scene_of(sphere(1, 24), shining(Rgb(3)));
  scene.instances.push_back({0, moved(5, 0, 0, -0.5F)});
  Stage stage(std::move(scene));
  stage.bounces = 0;
  stage.find_emitters();
  expect_near(stage.path({{5, 0.1, 4}, {0, 0, -1}}, 16), Rgb(3));
  const EmissiveTriangle shine =
      stage.world.emitters.sample(stage.context().scene, {9, 0, 0}, {0.99F, 0.5F});
  EXPECT_GT(shine.pdf, 0);
}

}  // namespace
}  // namespace gltfx::render
