// SPDX-License-Identifier: Apache-2.0
// Skies and seas do not hide the subject of a picture, and what is none of them stays.
#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include "preview/framing.hpp"
#include "render/shapes.hpp"

namespace gltfx::preview {
namespace {

using render::Mesh;
using render::Scene;

Mesh inside_out(Mesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

// A level square of n by n fields that faces up.
Mesh level_grid(float half, std::uint32_t n) {
  Mesh mesh;
  for (std::uint32_t z = 0; z <= n; ++z) {
    for (std::uint32_t x = 0; x <= n; ++x) {
      mesh.positions.push_back({half * (2 * static_cast<float>(x) / static_cast<float>(n) - 1), 0,
                                half * (2 * static_cast<float>(z) / static_cast<float>(n) - 1)});
      if (x == n || z == n) continue;
      const std::uint32_t at = z * (n + 1) + x;
      mesh.triangles.push_back({at, at + n + 1, at + 1});
      mesh.triangles.push_back({at + 1, at + n + 1, at + n + 2});
    }
  }
  return mesh;
}

// A trunk of 6 with a crown, on a small heap of sand.
Scene palm() {
  Scene scene = render::scene_of(render::sphere(1.5F));
  scene.instances[0].to_world = render::moved(0, 6, 0);
  scene.meshes.push_back(render::cube());
  scene.instances.push_back({1, {{{0.2F, 0, 0, 0}, {0, 3, 0, 3}, {0, 0, 0.2F, 0}}}});
  scene.instances.push_back({0, {{{1, 0, 0, 0}, {0, 0.2F, 0, 0}, {0, 0, 1, 0}}}});
  scene.materials.resize(2);
  return scene;
}

// The size of the subject of a palm with something around it, in sizes of the palm.
double size_with(Mesh mesh, const render::Matrix34& place = render::kIdentity,
                 const render::SceneMaterial& material = {}) {
  Scene scene = palm();
  scene.materials[1] = material;
  mesh.material = 1;
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back({2, place});
  return find_subject(scene)->size() / find_subject(palm())->size();
}

TEST(Surroundings, ASkyIsNoSubject) {
  render::SceneMaterial both;
  both.double_sided = true;
  EXPECT_NEAR(size_with(inside_out(render::sphere(100, 48))), 1, 1e-5);
  EXPECT_NEAR(size_with(render::sphere(100, 48), render::kIdentity, both), 1, 1e-5);
  EXPECT_NEAR(size_with(inside_out(render::cube(100))), 1, 1e-5);
  Mesh half = inside_out(render::sphere(100, 48));
  half.triangles.resize(half.triangles.size() / 2);  // from the top down
  EXPECT_NEAR(size_with(half), 1, 1e-5);

  Scene scene = palm();
  EXPECT_FALSE(find_subject(scene)->enclosed);
  scene.meshes.push_back(inside_out(render::sphere(100)));
  scene.instances.push_back({2, render::kIdentity});
  EXPECT_TRUE(find_subject(scene)->enclosed);
  scene.meshes.push_back(level_grid(100, 40));
  scene.instances.push_back({3, render::kIdentity});
  EXPECT_NEAR(find_subject(scene)->size() / find_subject(palm())->size(), 1, 1e-5) << "over a sea";
}

TEST(Surroundings, WhatShowsItsOutsideIsNoSky) {
  EXPECT_GT(size_with(render::sphere(100, 48)), 5) << "seen from outside";
  render::SceneMaterial glass;
  glass.double_sided = true;
  glass.factors.transmission = 1;
  EXPECT_GT(size_with(render::sphere(100, 48), render::kIdentity, glass), 5);
  EXPECT_GT(size_with(inside_out(render::sphere(12, 48))), 2) << "the camera would be outside";
  EXPECT_GT(size_with(inside_out(render::sphere(100, 48)), render::moved(0, -104, 0)), 5)
      << "below";
}

TEST(Surroundings, ASeaOfAnyDetailIsNoSubject) {
  for (const std::uint32_t fields : {1U, 4U, 40U, 120U}) {
    EXPECT_NEAR(size_with(level_grid(100, fields)), 1, 1e-5) << fields;
  }
  EXPECT_GT(size_with(level_grid(6, 40)), 1.5) << "a pond";
}

TEST(Surroundings, WhatIsLargeAndLevelStaysWithoutThingsThatRiseFromIt) {
  const auto with_part = [](const Mesh& large, const render::Matrix34& place) {
    Scene scene = render::scene_of(large);
    scene.meshes.push_back(render::cube(0.1F));
    scene.instances.push_back({1, place});
    return find_subject(scene)->size();
  };
  Mesh slab = render::cube();
  for (Float3& p : slab.positions) p[1] *= 0.05F;
  const double whole = find_subject(render::scene_of(slab))->size();
  EXPECT_GT(with_part(slab, render::moved(0.5F, 0.05F, 0.5F, 0.5F)), 0.9 * whole)
      << "a telephone with its lens";
  const Mesh sheet = level_grid(1, 40);
  EXPECT_GT(with_part(sheet, {{{1, 0, 0, 0}, {0, 0.05F, 0, 0}, {0, 0, 1, 0}}}), 2)
      << "a mark on a sheet of paper";
}

}  // namespace
}  // namespace gltfx::preview
