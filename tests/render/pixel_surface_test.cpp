// SPDX-License-Identifier: Apache-2.0
#include "render/pixel_surface.hpp"

#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "rendering.hpp"

namespace gltfx::render {
namespace {

constexpr std::uint32_t kPixels = 64;  // pixels of the picture, and texels of the texture
constexpr std::uint32_t kRays = 8;

// A sphere with a texture that grows brighter from the left to the right.
Scene painted_sphere() {
  static const std::vector<std::byte> kTexels = [] {
    std::vector<std::byte> pixels;
    for (std::uint32_t i = 0; i < kPixels * kPixels * 3; ++i) {
      pixels.push_back(static_cast<std::byte>(i / 3 % kPixels * 4));
    }
    return pixels;
  }();
  SceneMaterial material;
  material.use(Slot::base_color).texture = 0;
  Scene scene = scene_of(sphere(), material);
  scene.textures.push_back({kPixels, kPixels, 3, 8, kTexels, nullptr});
  return scene;
}

// Samples of one pixel of a picture that the sphere fills, except for the corners.
class Pixel {
 public:
  Pixel(const Stage& stage, std::uint32_t x, std::uint32_t y) : stage_(stage), x_(x), y_(y) {}

  CameraSample camera(std::uint32_t number) const {
    View view;
    view.origin = {0, 0, 4};
    view.half_width = view.half_height = 0.27;
    CameraSample sample;
    PixelSamples(kPixels, kPixels, 3, x_, y_).fill(view, number, {&sample, 1});
    return sample;
  }
  PathSample seen(const CameraSample& camera) const {
    return sample_features(stage_.context(), camera, stage_.context().bvh.first_layer(camera.ray));
  }
  bool fit(PixelSurface& surface) const {
    for (std::uint32_t i = 0; i < kRays; ++i) {
      const CameraSample sample = camera(i);
      surface.add(sample.point, stage_.context().bvh.first_layer(sample.ray), seen(sample));
    }
    return surface.fit();
  }

 private:
  const Stage& stage_;
  std::uint32_t x_, y_;
};

TEST(PixelSurface, IsWhatRaysSee) {
  const Stage stage(painted_sphere());
  std::uint32_t fits = 0;
  for (std::uint32_t y = 12; y < kPixels - 12; y += 4) {
    for (std::uint32_t x = 12; x < kPixels - 12; x += 4) {
      const Pixel pixel(stage, x, y);
      PixelSurface surface(stage.context().scene);
      if (!pixel.fit(surface)) continue;
      ++fits;
      for (std::uint32_t i = kRays; i < 3 * kRays; ++i) {
        const CameraSample camera = pixel.camera(i);
        const PathSample found = surface.at(camera.point);
        const PathSample seen = pixel.seen(camera);
        EXPECT_EQ(found.alpha, 1);
        EXPECT_NEAR(found.features.albedo.x, seen.features.albedo.x, 0.03);
        EXPECT_GT(dot(found.features.normal, seen.features.normal), 0.98);
        EXPECT_NEAR(found.features.depth, seen.features.depth, 0.1);
        EXPECT_EQ(found.features.material, seen.features.material);
      }
    }
  }
  EXPECT_GT(fits, 60U) << "of 100";
}

bool fits_in_the_middle(const Scene& scene) {
  const Stage stage(scene);
  PixelSurface surface(stage.context().scene);
  return Pixel(stage, 40, 30).fit(surface);
}

TEST(PixelSurface, AsksForOneSmoothTexturedSurface) {
  const Scene scene = painted_sphere();
  EXPECT_TRUE(fits_in_the_middle(scene));
  Scene colored = scene;
  colored.meshes[0].colors.resize(colored.meshes[0].positions.size(), {1, 1, 1, 1});
  EXPECT_FALSE(fits_in_the_middle(colored));
  Scene bright = scene;
  bright.materials[0].factors.emissive = Rgb(1);
  EXPECT_FALSE(fits_in_the_middle(bright));
  Scene holed = scene;
  holed.materials[0].alpha_mode = AlphaMode::blend;
  EXPECT_FALSE(fits_in_the_middle(holed));
  Scene plain = scene;
  plain.meshes[0].uvs.clear();
  EXPECT_FALSE(fits_in_the_middle(plain));
  Scene sets = scene;
  sets.meshes[0].uvs.resize(2, sets.meshes[0].uvs[0]);
  EXPECT_TRUE(fits_in_the_middle(sets));
  sets.meshes[0].uvs.resize(3, sets.meshes[0].uvs[0]);
  EXPECT_FALSE(fits_in_the_middle(sets));
}

TEST(PixelSurface, IsNoneAtSeamsAndOutlines) {
  const Stage stage(painted_sphere());
  PixelSurface seam(stage.context().scene);
  EXPECT_FALSE(Pixel(stage, kPixels / 2, 30).fit(seam)) << "u is 0 on one side and 1 on the other";
  PixelSurface outline(stage.context().scene);
  EXPECT_FALSE(Pixel(stage, 1, 32).fit(outline));
}

// Two spheres in a row, of which each fills one half of the pixel.
TEST(PixelSurface, IsOfOneBody) {
  Scene scene = painted_sphere();
  scene.instances = {{0, moved(-1, 0, 0)}, {0, moved(1, 0, 0)}};
  const Stage stage(std::move(scene));
  PixelSurface surface(stage.context().scene);
  EXPECT_FALSE(Pixel(stage, kPixels / 2, kPixels / 2).fit(surface));
}

}  // namespace
}  // namespace gltfx::render
