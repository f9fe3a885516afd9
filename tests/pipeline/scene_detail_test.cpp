// SPDX-License-Identifier: Apache-2.0
// How many texels a picture needs.
#include "pipeline/scene_detail.hpp"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/shapes.hpp"

namespace gltfx {
namespace {

using testing::ElementsAre;

// A square of two metres, whose diagonal fills the picture: so many texels of its image lie along
// one of 256 pixels.
render::Scene square(float uv_scale) {
  render::SceneMaterial material;
  material.use(render::Slot::base_color).texture = 0;
  render::Scene scene = render::scene_of(render::quad(), material);
  render::Mesh& mesh = scene.meshes.front();
  mesh.uvs = {{{0, 0}, {uv_scale, 0}, {uv_scale, uv_scale}, {0, uv_scale}}};
  scene.textures.resize(1);
  return scene;
}

// The side of a pixel of a picture with the square in it, which has so many of them along its side.
double pixel(int side) { return std::sqrt(8.0) / side; }

TEST(SceneDetail, TwoTexelsStayForEachPixel) {
  const std::vector<ImageSize> image{{2048, 2048}};
  // 2048 texels on 2 m, 256 pixels on 2.83 m: 11.3 texels a pixel, of which 2.8 stay.
  EXPECT_THAT(find_halvings(square(1), image, pixel(256)), ElementsAre(2));
  EXPECT_THAT(find_halvings(square(1), image, pixel(512)), ElementsAre(1));
  EXPECT_THAT(find_halvings(square(1), image, pixel(2048)), ElementsAre(0));
  EXPECT_THAT(find_halvings(square(4), image, pixel(256)), ElementsAre(4));
  EXPECT_THAT(find_halvings(square(0.1F), image, pixel(256)), ElementsAre(0));
}

// A small part that is stretched does not count; a larger one does.
TEST(SceneDetail, TheLeastDetailDecides) {
  render::Scene scene = square(1);
  render::Mesh& mesh = scene.meshes.front();
  mesh.uvs = {{{0, 0}, {1, 0}, {1, 1}, {1, 1}}};
  EXPECT_THAT(find_halvings(scene, {{2048, 2048}}, pixel(256)), ElementsAre(0))
      << "half has no detail";
  render::Mesh stretched = render::quad(0.1F);
  stretched.uvs = {{{0, 0}, {0, 0}, {0, 0}, {0, 0}}};
  scene = square(1);
  stretched.material = 0;
  scene.meshes.push_back(stretched);
  scene.instances.push_back({1, render::kIdentity});
  EXPECT_THAT(find_halvings(scene, {{2048, 2048}}, pixel(256)), ElementsAre(2))
      << "1 % has no detail";
}

TEST(SceneDetail, NothingIsKnownWithoutAPixelAnImageOrASurface) {
  EXPECT_THAT(find_halvings(square(1), {{2048, 2048}}, 0), ElementsAre(0));
  EXPECT_THAT(find_halvings(square(1), {{0, 0}}, pixel(256)), ElementsAre(0));
  EXPECT_THAT(find_halvings({}, {{2048, 2048}}, pixel(256)), ElementsAre(0));
}

}  // namespace
}  // namespace gltfx
