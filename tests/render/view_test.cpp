// SPDX-License-Identifier: Apache-2.0
#include "render/view.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "shapes.hpp"

namespace gltfx::render {
namespace {

TEST(View, ACameraOfTheAssetKeepsItsHeight) {
  Camera camera;
  camera.to_world = moved(1, 2, 3);
  camera.yfov = 1;
  const View view = view_of(camera, 2);
  EXPECT_NEAR(view.half_height, std::tan(0.5), 1e-6);
  EXPECT_NEAR(view.half_width, 2 * std::tan(0.5), 1e-6);
  const Ray middle = view.ray(0.5, 0.5);
  EXPECT_NEAR(middle.direction.z, -1, 1e-9);
  EXPECT_EQ(middle.origin, Vec3d(1, 2, 3));
  EXPECT_GT(view.ray(1, 0).direction.x, 0);
  EXPECT_GT(view.ray(1, 0).direction.y, 0);
}

TEST(View, NothingThatACameraOfTheAssetShowsIsCutOff) {
  Camera camera;
  camera.yfov = 1;
  camera.aspect_ratio = 2;
  const View quad = view_of(camera, 1);
  EXPECT_NEAR(quad.half_width, 2 * std::tan(0.5), 1e-6);
  EXPECT_NEAR(quad.half_height, 2 * std::tan(0.5), 1e-6);
  const View wide = view_of(camera, 4);
  EXPECT_NEAR(wide.half_width, 4 * std::tan(0.5), 1e-6);
  EXPECT_NEAR(wide.half_height, std::tan(0.5), 1e-6);
}

TEST(View, AnOrthographicCameraHasParallelRays) {
  Camera camera;
  camera.perspective = false;
  camera.xmag = 3;
  camera.ymag = 1;
  const View view = view_of(camera, 1);
  EXPECT_EQ(view.half_width, 3);
  EXPECT_EQ(view.half_height, 3);
  EXPECT_EQ(view.ray(0, 0).direction, view.ray(1, 1).direction);
  EXPECT_NEAR(view.ray(1, 0.5).origin.x, 3, 1e-9);
}

}  // namespace
}  // namespace gltfx::render
