// SPDX-License-Identifier: Apache-2.0
#include "preview/framing.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "base/packed.hpp"
#include "render/shapes.hpp"

namespace gltfx::preview {
namespace {

// Position of a point in the picture: 0 to 1 from the upper left.
Float2 in_picture(const render::View& view, const Vec3d& point) {
  const Vec3d p = point - view.origin;
  const double away = -dot(p, view.backward);
  return {static_cast<float>(0.5 + dot(p, view.right) / away / view.half_width / 2),
          static_cast<float>(0.5 - dot(p, view.up) / away / view.half_height / 2)};
}

void expect_framed(const render::Scene& scene, double aspect) {
  const auto subject = find_subject(scene);
  ASSERT_TRUE(subject);
  const render::View view = frame(*subject, usual_direction(*subject), aspect);
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
    render::Scene scene = render::scene_of(render::cube());
    scene.instances[0].to_world = render::moved(scale * 7, -scale, scale * 3, scale);
    for (const double aspect : {0.5, 1.0, 2.5}) expect_framed(scene, aspect);
  }
}

TEST(Framing, LooksAtTheFrontFromALittleAbove) {
  const auto subject = find_subject(render::scene_of(render::cube()));
  const render::View view = frame(*subject, usual_direction(*subject), 1);
  EXPECT_GT(view.origin.z, 0);
  EXPECT_GT(view.origin.x, 0);
  EXPECT_GT(view.origin.y, 0);
  EXPECT_NEAR(dot(view.right, view.up), 0, 1e-12);
  EXPECT_NEAR(view.right.y, 0, 1e-12) << "the horizon is level";
  EXPECT_GT(dot(cross(view.right, view.up), view.backward), 0.999);
}

TEST(Framing, AStrayVertexDoesNotCount) {
  render::Scene scene = render::scene_of(render::sphere());
  render::Mesh& mesh = scene.meshes[0];
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
    render::Scene scene = render::scene_of(render::sphere(1, 30));
    scene.meshes.push_back(render::quad(half));
    scene.instances.push_back({1, {{{1, 0, 0, 1}, {0, 0, 1, -1}, {0, -1, 0, 0}}}});
    const auto subject = find_subject(scene);
    EXPECT_NEAR(subject->greatest.x, half == 3.0F ? 4 : 1, 1e-5);
    EXPECT_NEAR(subject->least.x, half == 3.0F ? -2 : -1, 1e-5);
  }
}

// As the picture of a house with a bird far off.
TEST(Framing, WhatIsTinyAndFarAwayHalvesNoPicture) {
  for (const float place : {3.0F, 30.0F, 3e4F, 3e12F}) {
    render::Scene scene = render::scene_of(render::sphere(1, 30));
    scene.meshes.push_back(render::cube(0.05F));
    scene.instances.push_back({1, render::moved(place, 0.3F, 0)});
    scene.instances.push_back({1, render::moved(0, 0.3F, -place)});
    EXPECT_NEAR(find_subject(scene)->size(),
                find_subject(render::scene_of(render::sphere(1, 30)))->size(), 1e-5);
    scene.instances.push_back({1, render::moved(1.3F, 0.3F, 0)});
    EXPECT_NEAR(find_subject(scene)->greatest.x, 1.35, 1e-5) << "what is near belongs to it";
  }
}

// A cottage and a figure that is a quarter as large.
TEST(Framing, AFigureFarFromACottageHalvesNoPicture) {
  const auto width_with_figure = [](float place) {
    render::Scene scene = render::scene_of(render::cube());
    scene.instances[0].to_world = {{{2.5F, 0, 0, 0}, {0, 2, 0, 2}, {0, 0, 2.5F, 0}}};
    scene.meshes.push_back(render::cube());
    scene.instances.push_back({1, {{{0.25F, 0, 0, place}, {0, 0.9F, 0, 0.9F}, {0, 0, 0.2F, 2}}}});
    return find_subject(scene)->greatest.x;
  };
  EXPECT_NEAR(width_with_figure(12), 2.5, 1e-5);
  EXPECT_NEAR(width_with_figure(4), 4.25, 1e-5) << "beside it";
}

TEST(Framing, ManyOfOneSizeAreAllShown) {
  render::Scene scene = render::scene_of(render::cube(0.1F));
  for (int i = 1; i < 9; ++i) {
    scene.instances.push_back({0, render::moved(static_cast<float>(i * i), 0, 0)});
  }
  EXPECT_NEAR(find_subject(scene)->greatest.x, 64.1, 1e-4);
}

TEST(Framing, LooksFromWhereFrontsAre) {
  render::Scene scene = render::scene_of(render::quad());
  const auto direction = [&](const render::Matrix34& place) {
    scene.instances[0].to_world = place;
    return usual_direction(*find_subject(scene));
  };
  const Direction front = direction(render::kIdentity);
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
  render::Scene scene = render::scene_of(render::sphere());
  scene.materials.emplace_back();
  scene.meshes.push_back(render::cube(2));
  scene.meshes[1].material = 1;
  scene.instances.push_back({1, render::kIdentity});
  EXPECT_NEAR(find_subject(scene)->greatest.x, 2, 1e-5);
  scene.materials[1].alpha_mode = render::AlphaMode::blend;
  EXPECT_NEAR(find_subject(scene)->greatest.x, 2, 1e-5);
  scene.materials[1].alpha = 0;
  EXPECT_NEAR(find_subject(scene)->greatest.x, 1, 1e-5);
  scene.materials[1].alpha_mode = render::AlphaMode::mask;
  scene.materials[1].alpha = 0.4F;
  scene.materials[1].alpha_cutoff = 0.5F;
  EXPECT_NEAR(find_subject(scene)->greatest.x, 1, 1e-5);
  scene.materials[0] = scene.materials[1];
  EXPECT_FALSE(find_subject(scene));
}

TEST(Framing, WhatIsLongAndThinIsShownWhole) {
  render::Scene scene = render::scene_of(render::sphere());
  scene.meshes.push_back(render::cube());
  scene.instances.push_back({1, {{{0.05F, 0, 0, 0}, {0, 1.5F, 0, 2}, {0, 0, 0.05F, 0}}}});
  EXPECT_NEAR(find_subject(scene)->greatest.y, 3.5, 1e-5);
}

TEST(Framing, NothingToSeeHasNoFrame) {
  EXPECT_FALSE(find_subject({}));
  render::Scene scene = render::scene_of(render::Mesh());
  EXPECT_FALSE(find_subject(scene));
}

TEST(Framing, DirectionsAreAnglesAroundTheSubject) {
  const auto subject = find_subject(render::scene_of(render::cube()));
  EXPECT_NEAR(frame(*subject, {0, 0}, 1).backward.z, 1, 1e-9);
  EXPECT_NEAR(frame(*subject, {90, 0}, 1).backward.x, 1, 1e-9);
  const render::View above = frame(*subject, {0, 90}, 1);
  EXPECT_NEAR(above.backward.y, 1, 1e-9);
  EXPECT_NEAR(above.right.x, 1, 1e-9);
  EXPECT_NEAR(above.up.z, -1, 1e-9);
}

}  // namespace
}  // namespace gltfx::preview
