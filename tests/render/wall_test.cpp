// SPDX-License-Identifier: Apache-2.0
/// Light that comes in where the camera looks in.
#include "render/wall.hpp"

#include <numbers>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "preview/lighting.hpp"
#include "render/bvh_groups.hpp"
#include "rendering.hpp"
#include "sanitized.hpp"

namespace gltfx::render {
namespace {

const Ray kWallTowards{{0.25, 0.5, 5}, {0, 0, -1}};
const Ray kWallFromBehind{{0.25, 0.5, -5}, {0, 0, 1}};

Bvh wall_bvh(const Scene& scene) {
  auto bvh = Bvh::build(scene);
  EXPECT_TRUE(bvh);
  return *std::move(bvh);
}

Eye eye_at(const Vec3d& place) {
  View view;
  view.origin = place;
  return Eye(view);
}

// A square of a material, seen from its front at +z: single, mirrored, and as a shared mesh.
std::vector<Scene> squares(const SceneMaterial& material) {
  std::vector<Scene> scenes(3, scene_of(quad(), material));
  scenes[1].instances[0].to_world[0][0] = -1;
  Mesh far = sphere(1, 40);
  for (Float3& p : far.positions) p[1] += 50;
  far.material = 0;
  scenes[2].meshes.push_back(far);
  scenes[2].instances = {{0, kIdentity, 2}, {0, moved(0, 300, 0), 2}};
  return scenes;
}

TEST(Wall, AFrontThrowsAShadowAndABackLetsLightIn) {
  for (const Scene& scene : squares({})) {
    const Bvh bvh = wall_bvh(scene);
    EXPECT_EQ(bvh.visibility(kWallFromBehind), 0) << "light meets the front";
    EXPECT_EQ(bvh.visibility(kWallTowards), 1) << "light meets the back";
    EXPECT_EQ(bvh.visibility(kWallTowards, eye_at({0, 0, -9})), 1) << "the eye sees the back, too";
    EXPECT_EQ(bvh.visibility(kWallTowards, eye_at({0, 0, 9})), 0) << "the eye sees the front";
    EXPECT_EQ(bvh.visibility(kWallFromBehind, eye_at({0, 0, -9})), 0);
    View level;
    level.perspective = false;
    level.backward = {0, 0.6, -0.8};
    EXPECT_EQ(bvh.visibility(kWallTowards, Eye(level)), 1);
    level.backward = {0, 0.6, 0.8};
    EXPECT_EQ(bvh.visibility(kWallTowards, Eye(level)), 0);
  }
}

// As spheres of revolution have it, whose last corners are computed from an angle of 2 pi.
TEST(Wall, ASeamThatRoundingOpensIsClosed) {
  Mesh seam = cube();
  ASSERT_TRUE(is_closed(seam));
  std::vector<Float3> positions(seam.positions.begin(), seam.positions.end());
  auto triangles = std::vector(seam.triangles.begin(), seam.triangles.end());
  const std::uint32_t corner = triangles.front()[0];
  positions.push_back(positions[corner]);
  triangles.front()[0] = static_cast<std::uint32_t>(positions.size() - 1);
  const auto moved_by = [&](float distance) {
    positions.back()[0] = positions[corner][0] + distance;
    Mesh mesh;
    mesh.positions = positions;
    mesh.triangles = triangles;
    return mesh;
  };
  EXPECT_TRUE(is_closed(moved_by(2e-7F)));
  EXPECT_TRUE(is_closed(moved_by(-5e-7F)));
  EXPECT_FALSE(is_closed(moved_by(0.01F)));
}

// A lamp in a closed body lights nothing outside, whichever sides the eye sees.
TEST(Wall, AClosedBodyIsSolid) {
  EXPECT_TRUE(is_closed(cube()));
  EXPECT_FALSE(is_closed(quad()));
  Mesh open = cube();
  open.triangles.pop_back();
  EXPECT_FALSE(is_closed(open));
  Mesh inside = cube();
  for (auto& triangle : inside.triangles) std::swap(triangle[1], triangle[2]);
  EXPECT_FALSE(is_closed(inside));
  const Bvh bvh = wall_bvh(scene_of(cube()));
  const Ray to_the_middle{{0.25, 0.5, 5}, {0, 0, -1}, 5};
  EXPECT_EQ(bvh.visibility(to_the_middle), 0);
  EXPECT_EQ(bvh.visibility(to_the_middle, eye_at({0, 0, -9})), 0);
  const Ray out{{0.25, 0.5, 0}, {0, 0, 1}};
  EXPECT_FALSE(bvh.intersect(out, 0)) << "as a camera inside";
  EXPECT_TRUE(bvh.intersect(out, 0, Backs::solid));
}

TEST(Wall, WhatIsClearOrDoubleSidedIsNone) {
  SceneMaterial material;
  material.double_sided = true;
  for (const Scene& scene : squares(material)) {
    EXPECT_EQ(wall_bvh(scene).visibility(kWallFromBehind), 0);
    EXPECT_EQ(wall_bvh(scene).visibility(kWallTowards), 0);
  }
  for (const bool diffuse : {false, true}) {
    material = {};
    (diffuse ? material.factors.diffuse_transmission : material.factors.transmission) = 0.5;
    for (const Scene& scene : squares(material)) {
      EXPECT_EQ(wall_bvh(scene).visibility(kWallFromBehind), 1);
      EXPECT_EQ(wall_bvh(scene).visibility(kWallTowards), 0);
    }
  }
}

TEST(Wall, HolesCountFromBothSides) {
  SceneMaterial material;
  material.alpha_mode = AlphaMode::blend;
  material.alpha = 0.25F;
  for (const Scene& scene : squares(material)) {
    EXPECT_FLOAT_EQ(wall_bvh(scene).visibility(kWallFromBehind), 0.75F);
    EXPECT_EQ(wall_bvh(scene).visibility(kWallTowards), 1);
  }
}

// A cube from the inside, whose walls are seen from there only.
Scene walled_room(const SceneMaterial& wall) {
  Scene scene = scene_of(cube(2), wall);
  for (auto& triangle : scene.meshes[0].triangles) std::swap(triangle[1], triangle[2]);
  return scene;
}

Stage lit(Scene scene, const std::optional<Vec3d>& eye) {
  Stage stage(std::move(scene));
  stage.world.environment.emplace(even_light());
  if (eye) stage.world.eye = eye_at(*eye);
  return stage;
}

// For any scattering of the walls, the environment counts once: white walls are as bright as it is.
TEST(Wall, ARoomUnderEvenLightIsAFurnace) {
  for (const double albedo : {0.3, 1.0}) {
    const Vec3d outside(3, 7, 9);
    const Ray look{outside, normalize(Vec3d(-0.3, -1.5, -1) - outside)};
    const Stage inside = lit(walled_room(matte(Rgb(albedo))), std::nullopt);
    expect_near(inside.path(look), Rgb(albedo), 1e-3);
    expect_near(inside.simply(look), Rgb(albedo), 1e-3);
    Stage stage = lit(walled_room(matte(Rgb(albedo))), outside);
    stage.bounces = 64;
    const Estimate fast = stage.path(look);
    const Estimate simple = stage.simply(look);
    expect_near(fast, simple.mean, 3.5 * simple.error.x);
    EXPECT_LE(fast.mean.x, albedo + 3.5 * fast.error.x + 1e-3);
    EXPECT_GT(fast.mean.x, albedo * 0.5) << "the light of what is open";
    stage.world.eye = eye_at({0, 0, 0});
    expect_near(stage.path({{0, 0, 0}, {0, 0, -1}}), Rgb(0));  // nothing is open
  }
}

TEST(Wall, ACameraInAClosedRoomHasNoEye) {
  const Bvh bvh = wall_bvh(walled_room({}));
  View view;
  view.origin = {0.5, 0.2, 1};
  EXPECT_FALSE(preview::eye_of(view, bvh));
  view.origin = {0.5, 0.2, 9};
  EXPECT_TRUE(preview::eye_of(view, bvh));
  const Scene ground = scene_of(quad(100));
  view.origin = {0, 0, 2};
  EXPECT_TRUE(preview::eye_of(view, wall_bvh(ground)));
}

// A sheet above the floor, once with its front to the lamp and once with its back.
TEST(Wall, ASheetThrowsAShadowByTheSideThatFacesTheLamp) {
  const Ray look{{4, 0, 1.5}, normalize(Vec3d(-4, 0, -1.5))};
  for (const bool shone_on : {false, true}) {
    Scene scene = scene_of(quad(4), matte(Rgb(0.5)));
    scene.meshes.push_back(quad(1));
    scene.meshes[1].material = 0;
    const float up = shone_on ? 1.0F : -1.0F;
    scene.instances.push_back({1, {{{1, 0, 0, 0}, {0, up, 0, 0}, {0, 0, up, 1}}}});
    Stage stage(std::move(scene));
    stage.world.eye = eye_at({4, 0, 1.5});
    Light sun;
    sun.kind = Light::Kind::directional;
    sun.direction = {0, 0, -1};
    stage.world.lights = {sun};
    stage.bounces = 1;
    const double expected = shone_on ? 0 : 0.5 / std::numbers::pi;
    expect_near(stage.path(look, 100), Rgb(expected), 1e-5);
    expect_near(stage.simply(look, 100), Rgb(expected), 1e-5);
  }
}

// A lamp outside of the room, a panel that is a part of it, and things inside.
TEST(Wall, BothIntegratorsAgreeInARoom) {
  Scene scene = walled_room(matte({0.8, 0.6, 0.4}));
  const auto add = [&scene](Mesh mesh, const SceneMaterial& material, const Matrix34& place) {
    mesh.material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(material);
    scene.instances.push_back({static_cast<std::uint32_t>(scene.meshes.size()), place});
    scene.meshes.push_back(std::move(mesh));
  };
  SceneMaterial lamp = matte(Rgb(0));
  lamp.factors.emissive = {3, 2, 1};
  add(sphere(1.5F, 8), lamp, moved(0, 4.5F, 0));
  SceneMaterial glossy = matte({0.5, 0.5, 0.9});
  glossy.factors.specular = 1;
  glossy.factors.roughness = 0.4;
  add(cube(0.6F), glossy, moved(0.5F, -1.4F, -0.5F));
  constexpr std::uint32_t kPaths = kSanitized ? 2000 : 8000;
  const Vec3d outside(6, 7, 9);
  for (const std::optional<Vec3d>& eye : {std::optional<Vec3d>(outside), std::optional<Vec3d>()}) {
    Stage stage = lit(scene, eye);
    stage.bounces = 4;
    for (const bool found : {false, true}) {
      if (found) stage.find_emitters();
      for (const Vec3d& target : {Vec3d(-1, -2, 0), Vec3d(-2, 0.5, 1), Vec3d(0.5, -0.8, -0.5)}) {
        const Ray look{outside, normalize(target - outside)};
        const Estimate simple = stage.simply(look, 7 * kPaths);
        expect_near(stage.path(look, kPaths), simple.mean, 3.5 * simple.error.x + 1e-3);
      }
    }
  }
}

}  // namespace
}  // namespace gltfx::render
