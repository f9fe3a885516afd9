// SPDX-License-Identifier: Apache-2.0
#include "bake/framing.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "base/packed.hpp"
#include "shapes.hpp"

namespace gltfx::bake {
namespace {

// Where a point comes to lie in the picture: 0 to 1 from the upper left.
Float2 in_picture(const View& view, const Vec3d& point) {
  const Vec3d p = point - view.origin;
  const double away = -dot(p, view.backward);
  return {static_cast<float>(0.5 + dot(p, view.right) / away / view.half_width / 2),
          static_cast<float>(0.5 - dot(p, view.up) / away / view.half_height / 2)};
}

void expect_framed(const Scene& scene, double aspect) {
  const auto subject = find_subject(scene);
  ASSERT_TRUE(subject);
  const View view = frame(*subject, usual_direction(*subject), aspect);
  float least = 1;
  float greatest = 0;
  for (const Float3& corner : subject->points) {
    const Vec3d point = to_vec(corner);
    for (const float coordinate : in_picture(view, point)) {
      least = std::min(least, coordinate);
      greatest = std::max(greatest, coordinate);
    }
  }
  EXPECT_GT(least, 0.02F);
  EXPECT_LT(greatest, 0.98F);
  EXPECT_GT(greatest - least, 0.8F) << "as large as it goes";
}

TEST(Framing, FillsThePictureAtAnyScale) {
  for (const float scale : {1e-3F, 1.0F, 1e3F}) {
    Scene scene = scene_of(cube());
    scene.instances[0].to_world = moved(scale * 7, -scale, scale * 3, scale);
    for (const double aspect : {0.5, 1.0, 2.5}) expect_framed(scene, aspect);
  }
}

TEST(Framing, LooksAtTheFrontFromALittleAbove) {
  const auto subject = find_subject(scene_of(cube()));
  const View view = frame(*subject, usual_direction(*subject), 1);
  EXPECT_GT(view.origin.z, 0);
  EXPECT_GT(view.origin.x, 0);
  EXPECT_GT(view.origin.y, 0);
  EXPECT_NEAR(dot(view.right, view.up), 0, 1e-12);
  EXPECT_NEAR(view.right.y, 0, 1e-12) << "the horizon is level";
  EXPECT_GT(dot(cross(view.right, view.up), view.backward), 0.999);
}

TEST(Framing, AStrayVertexDoesNotCount) {
  Scene scene = scene_of(sphere());
  Mesh& mesh = scene.meshes[0];
  mesh.positions.push_back({1e5F, 0, 0});
  mesh.normals.push_back({0, 1, 0});
  const auto last = static_cast<std::uint32_t>(mesh.positions.size()) - 1;
  EXPECT_NEAR(find_subject(scene)->greatest.x, 1, 1e-5) << "of no triangle";
  mesh.triangles.push_back({0, 1, last});
  EXPECT_NEAR(find_subject(scene)->greatest.x, 1, 1e-5);
  expect_framed(scene, 1);
}

// A level square below a sphere, its corners so few that they are beyond all percentiles, and some
// of them farther away than others.
TEST(Framing, AGroundIsShownWholeOrCountsAsNone) {
  for (const float half : {3.0F, 6.0F}) {
    Scene scene = scene_of(sphere(1, 30));
    scene.meshes.push_back(quad(half));
    scene.instances.push_back({1, {{{1, 0, 0, 1}, {0, 0, 1, -1}, {0, -1, 0, 0}}}});
    const auto subject = find_subject(scene);
    EXPECT_NEAR(subject->greatest.x, half == 3.0F ? 4 : 1, 1e-5);
    EXPECT_NEAR(subject->least.x, half == 3.0F ? -2 : -1, 1e-5);
  }
}

// As the picture of a house with a bird far off.
TEST(Framing, WhatIsTinyAndFarAwayHalvesNoPicture) {
  for (const float place : {3.0F, 30.0F, 3e4F, 3e12F}) {
    Scene scene = scene_of(sphere(1, 30));
    scene.meshes.push_back(cube(0.05F));
    scene.instances.push_back({1, moved(place, 0.3F, 0)});
    scene.instances.push_back({1, moved(0, 0.3F, -place)});
    EXPECT_NEAR(find_subject(scene)->size(), find_subject(scene_of(sphere(1, 30)))->size(), 1e-5);
    scene.instances.push_back({1, moved(1.3F, 0.3F, 0)});
    EXPECT_NEAR(find_subject(scene)->greatest.x, 1.35, 1e-5) << "what is near belongs to it";
  }
}

TEST(Framing, ManyOfOneSizeAreAllShown) {
  Scene scene = scene_of(cube(0.1F));
  for (int i = 1; i < 9; ++i) {
    scene.instances.push_back({0, moved(static_cast<float>(i * i), 0, 0)});
  }
  EXPECT_NEAR(find_subject(scene)->greatest.x, 64.1, 1e-4);
}

TEST(Framing, LooksFromWhereFrontsAre) {
  Scene scene = scene_of(quad());
  const auto direction = [&](const Matrix34& place) {
    scene.instances[0].to_world = place;
    return usual_direction(*find_subject(scene));
  };
  const Direction front = direction(kIdentity);
  EXPECT_NEAR(front.azimuth, 20, 1e-9);
  const Direction behind = direction({{{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}}});
  EXPECT_NEAR(behind.azimuth, 200, 1e-9);
  EXPECT_GT(behind.elevation, 0);
  const Direction mirrored = direction({{{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}});
  EXPECT_NEAR(mirrored.azimuth, 20, 1e-9) << "triangles go round the other way";
  const Direction below = direction({{{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}}});
  EXPECT_LT(below.elevation, 0);
  scene.materials[0].double_sided = true;
  EXPECT_GT(usual_direction(*find_subject(scene)).elevation, 0);
}

TEST(Framing, WhatAlphaMakesInvisibleIsNotThere) {
  Scene scene = scene_of(sphere());
  scene.materials.emplace_back();
  scene.meshes.push_back(cube(2));
  scene.meshes[1].material = 1;
  scene.instances.push_back({1, kIdentity});
  EXPECT_NEAR(find_subject(scene)->greatest.x, 2, 1e-5);
  scene.materials[1].alpha_mode = AlphaMode::blend;
  EXPECT_NEAR(find_subject(scene)->greatest.x, 2, 1e-5);
  scene.materials[1].alpha = 0;
  EXPECT_NEAR(find_subject(scene)->greatest.x, 1, 1e-5);
  scene.materials[1].alpha_mode = AlphaMode::mask;
  scene.materials[1].alpha = 0.4F;
  scene.materials[1].alpha_cutoff = 0.5F;
  EXPECT_NEAR(find_subject(scene)->greatest.x, 1, 1e-5);
  scene.materials[0] = scene.materials[1];
  EXPECT_FALSE(find_subject(scene));
}

TEST(Framing, WhatIsLongAndThinIsShownWhole) {
  Scene scene = scene_of(sphere());
  scene.meshes.push_back(cube());
  scene.instances.push_back({1, {{{0.05F, 0, 0, 0}, {0, 1.5F, 0, 2}, {0, 0, 0.05F, 0}}}});
  EXPECT_NEAR(find_subject(scene)->greatest.y, 3.5, 1e-5);
}

TEST(Framing, NothingToSeeHasNoFrame) {
  EXPECT_FALSE(find_subject({}));
  Scene scene = scene_of(Mesh());
  EXPECT_FALSE(find_subject(scene));
}

TEST(Framing, DirectionsAreAnglesAroundTheSubject) {
  const auto subject = find_subject(scene_of(cube()));
  EXPECT_NEAR(frame(*subject, {0, 0}, 1).backward.z, 1, 1e-9);
  EXPECT_NEAR(frame(*subject, {90, 0}, 1).backward.x, 1, 1e-9);
  const View above = frame(*subject, {0, 90}, 1);
  EXPECT_NEAR(above.backward.y, 1, 1e-9);
  EXPECT_NEAR(above.right.x, 1, 1e-9);
  EXPECT_NEAR(above.up.z, -1, 1e-9);
}

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
}  // namespace gltfx::bake
