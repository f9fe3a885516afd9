// SPDX-License-Identifier: Apache-2.0
#include "render/bvh.hpp"

#include <array>
#include <optional>
#include <span>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/packed.hpp"
#include "base/parallel.hpp"
#include "base/support/two_at_once.hpp"
#include "render/bvh_groups.hpp"
#include "render/sampler.hpp"
#include "shader/random.hpp"
#include "shapes.hpp"

namespace gltfx::render {
namespace {

const Ray kTowards{{0.25F, 0.5F, 5}, {0, 0, -1}};
const Ray kFromBehind{{0.25F, 0.5F, -5}, {0, 0, 1}};

Bvh bvh_of(const Scene& scene) {
  auto bvh = Bvh::build(scene);
  EXPECT_TRUE(bvh);
  return *std::move(bvh);
}

TEST(Bvh, ARayHitsWhereTheTriangleIs) {
  const Scene scene = scene_of(quad());
  const Bvh bvh = bvh_of(scene);
  const auto hit = bvh.intersect(kTowards, 0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 5, 1e-5);  // Embree divides by an approximate reciprocal
  EXPECT_EQ(hit->instance, 0U);
  EXPECT_EQ(hit->triangle, 1U);
  EXPECT_FALSE(bvh.intersect({{2, 0, 5}, {0, 0, -1}}, 0));
  EXPECT_EQ(bvh.triangles(), 2U);
}

TEST(Bvh, WeightsAreThoseOfTheSecondAndThirdVertex) {
  const Scene scene = scene_of(quad());
  const auto hit = bvh_of(scene).intersect({{0.5F, -0.9F, 5}, {0, 0, -1}}, 0);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->triangle, 0U);
  const Float3 a{-1, -1, 0};
  const Float3 b{1, -1, 0};
  const Float3 c{1, 1, 0};
  const float w = 1 - hit->u - hit->v;
  EXPECT_NEAR(w * a[0] + hit->u * b[0] + hit->v * c[0], 0.5F, 1e-5F);
  EXPECT_NEAR(w * a[1] + hit->u * b[1] + hit->v * c[1], -0.9F, 1e-5F);
}

TEST(Bvh, BackFacesOfSingleSidedMaterialsAreNotThere) {
  Scene scene = scene_of(quad());
  EXPECT_FALSE(bvh_of(scene).intersect(kFromBehind, 0));
  EXPECT_TRUE(bvh_of(scene).intersect(kFromBehind, 0, Backs::solid));
  scene.materials[0].double_sided = true;
  const Bvh bvh = bvh_of(scene);
  const auto hit = bvh.intersect(kFromBehind, 0);
  ASSERT_TRUE(hit);
  EXPECT_EQ(bvh.visibility(kFromBehind), 0);
}

TEST(Bvh, AMirrorTurnsTheWindingOver) {
  Scene scene = scene_of(quad());
  scene.instances[0].to_world[0][0] = -1;
  EXPECT_TRUE(bvh_of(scene).intersect(kTowards, 0));
  EXPECT_FALSE(bvh_of(scene).intersect(kFromBehind, 0));
  scene.instances.push_back({0, moved(5, 0, 0)});  // now a shared mesh
  EXPECT_TRUE(bvh_of(scene).intersect(kTowards, 0));
  EXPECT_FALSE(bvh_of(scene).intersect(kFromBehind, 0));
}

TEST(Bvh, InstancesShareAMesh) {
  Scene scene = scene_of(quad());
  scene.instances.push_back({0, moved(10, 0, 2, 2)});
  scene.meshes.push_back(cube());
  scene.instances.push_back({1, moved(20, 0, 0)});
  const Bvh bvh = bvh_of(scene);
  const auto second = bvh.intersect({{11.9F, 0, 5}, {0, 0, -1}}, 0);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->instance, 1U);
  EXPECT_NEAR(second->distance, 3, 1e-5);
  const auto third = bvh.intersect({{20, 0, 5}, {0, 0, -1}}, 0);
  ASSERT_TRUE(third);
  EXPECT_EQ(third->instance, 2U);
  EXPECT_NEAR(third->distance, 4, 1e-5);
  EXPECT_EQ(bvh.triangles(), 16U);
}

TEST(Bvh, AMaskCutsHoles) {
  Scene scene = scene_of(quad());
  scene.materials[0].double_sided = true;
  scene.materials[0].alpha_mode = AlphaMode::mask;
  scene.materials[0].alpha = 0.49F;
  EXPECT_FALSE(bvh_of(scene).intersect(kTowards, 0));
  EXPECT_EQ(bvh_of(scene).visibility(kTowards), 1);
  scene.materials[0].alpha = 0.5F;
  EXPECT_TRUE(bvh_of(scene).intersect(kTowards, 0));
  EXPECT_EQ(bvh_of(scene).visibility(kTowards), 0);
}

TEST(Bvh, BlendingIsCoverage) {
  Scene scene = scene_of(quad());
  scene.materials[0].double_sided = true;
  scene.materials[0].alpha_mode = AlphaMode::blend;
  scene.materials[0].alpha = 0.25F;
  scene.instances.push_back({0, moved(0, 0, 1)});
  const Bvh bvh = bvh_of(scene);
  EXPECT_FLOAT_EQ(bvh.visibility(kTowards), 0.75F * 0.75F);
  int first = 0;
  int second = 0;
  for (std::uint32_t key = 0; key < 4000; ++key) {
    const auto hit = bvh.intersect(kTowards, key);
    first += hit && hit->instance == 1;
    second += hit && hit->instance == 0;
  }
  EXPECT_NEAR(first / 4000.0, 0.25, 0.02);
  EXPECT_NEAR(second / 4000.0, 0.75 * 0.25, 0.02);
}

// Spheres that are culled, shared, mirrored, and covered in part, with a cube in the middle.
Scene crowd() {
  Scene scene = scene_of(sphere());
  scene.materials.resize(3);
  scene.materials[1].alpha_mode = AlphaMode::blend;
  scene.materials[1].alpha = 0.4F;
  scene.materials[2].double_sided = true;
  for (std::uint32_t material = 1; material < 3; ++material) {
    scene.meshes.push_back(sphere());
    scene.meshes.back().material = material;
  }
  scene.meshes.push_back(cube(0.5F));
  scene.instances = {{0, moved(-2, 0, 0)}, {0, moved(0, 2, 0)},  {0, moved(2, 0, 0, -1)},
                     {1, moved(0, -2, 0)}, {1, moved(0, 0, -2)}, {2, moved(0, 0, 2, 0.5F)},
                     {3, kIdentity}};
  return scene;
}

TEST(Bvh, ManyRaysMeetWhatEachOneMeets) {
  const Scene scene = crowd();
  const Bvh bvh = bvh_of(scene);
  shader::test::Chance chance(7);
  std::size_t met = 0;
  for (unsigned round = 0; round < 4000; ++round) {
    std::array<Ray, Bvh::kCameraPacket> rays;
    const std::size_t count = 1 + round % rays.size();
    const Vec3d origin = chance.anywhere() * 5.0;
    for (Ray& ray : rays) {
      ray = {origin, normalize(chance.anywhere() * 2.0 + chance.anywhere() * 0.05 - origin)};
    }
    std::array<std::optional<Hit>, rays.size()> hits;
    bvh.first_layers(std::span(rays).first(count), hits);
    for (std::size_t i = 0; i < count; ++i) {
      const auto alone = bvh.first_layer(rays[i]);
      ASSERT_EQ(hits[i].has_value(), alone.has_value());
      if (!alone) continue;
      ++met;
      EXPECT_EQ(hits[i]->body(), alone->body());
      EXPECT_EQ(hits[i]->triangle, alone->triangle);
      EXPECT_NEAR(hits[i]->distance, alone->distance, 1e-4);
      EXPECT_NEAR(hits[i]->u, alone->u, 1e-3);
      EXPECT_NEAR(hits[i]->v, alone->v, 1e-3);
    }
  }
  EXPECT_GT(met, 4000U);
}

TEST(Bvh, RaysMeetTheSameWhateverTheMethod) {
  const Scene scene = crowd();
  const Bvh sah = bvh_of(scene);
  const auto morton = Bvh::build(scene, BvhMethod::morton);
  ASSERT_TRUE(morton);
  shader::test::Chance chance(9);
  std::size_t met = 0;
  for (std::uint32_t i = 0; i < 8000; ++i) {
    const Vec3d origin = chance.anywhere() * 5.0;
    const Ray ray{origin, normalize(chance.anywhere() * 2.0 - origin)};
    const auto hit = sah.intersect(ray, i);
    const auto other = morton->intersect(ray, i);
    ASSERT_EQ(hit.has_value(), other.has_value());
    if (!hit) continue;
    ++met;
    EXPECT_EQ(hit->body(), other->body());
    EXPECT_NEAR(hit->distance, other->distance, 1e-4);
  }
  EXPECT_GT(met, 2000U);
}

TEST(Bvh, ManyShadowRaysGetAsFarAsEachOne) {
  const Scene scene = crowd();
  const Bvh bvh = bvh_of(scene);
  shader::test::Chance chance(8);
  std::array<std::size_t, 3> found{};  // in shadow, in part, in light
  for (unsigned round = 0; round < 4000; ++round) {
    std::array<Ray, Bvh::kShadowPacket> rays;
    const std::size_t count = 1 + round % rays.size();
    const Vec3d origin = chance.anywhere() * chance.between(0.9, 4);
    for (Ray& ray : rays) ray = {origin, chance.anywhere()};
    std::array<float, rays.size()> visible{};
    bvh.find_visibility(std::span(rays).first(count), std::nullopt, visible);
    for (std::size_t i = 0; i < count; ++i) {
      const float alone = bvh.visibility(rays[i]);
      EXPECT_FLOAT_EQ(visible[i], alone);
      ++found.at(alone <= 0 ? 0 : alone < 1 ? 1 : 2);
    }
  }
  EXPECT_THAT(found, testing::Each(testing::Gt(500U)));
}

TEST(Bvh, LeavesThreadsToThoseWhoTrace) {
  if (default_jobs() < 2) GTEST_SKIP() << "one processor";
  const Scene scene = scene_of(quad());
  const Bvh bvh = bvh_of(scene);
  EXPECT_TRUE(gltfx::test::two_run_at_once());
}

TEST(Bvh, NothingToHitIsNoError) {
  const Scene scene;
  const Bvh bvh = bvh_of(scene);
  EXPECT_FALSE(bvh.intersect(kTowards, 0));
  EXPECT_EQ(bvh.visibility(kTowards), 1);
}

// Two meshes in each place, so large that they are shared.
TEST(Bvh, SharedMeshesAreTheSameInEveryPlace) {
  for (const bool double_sided : {false, true}) {
    Scene scene = scene_of(sphere());
    scene.materials[0].double_sided = double_sided;
    scene.materials.emplace_back().double_sided = true;
    scene.meshes.push_back(cube(0.3F));
    scene.meshes[1].material = 1;
    for (Float3& p : scene.meshes[1].positions) p[1] += 2;
    scene.instances = {{0, kIdentity, 2}, {0, moved(5, 0, 1, 2), 2}, {0, moved(9, 0, 0, -1), 2}};
    EXPECT_THAT(group_instances(scene).instanced, testing::SizeIs(3));
    const Bvh bvh = bvh_of(scene);
    EXPECT_EQ(bvh.triangles(), 3 * (scene.meshes[0].triangles.size() + 12));
    const auto meets = [&](const Vec3d& from, std::uint32_t instance, std::uint32_t mesh,
                           double distance) {
      const auto hit = bvh.intersect({from, {0, 0, -1}}, 0);
      ASSERT_TRUE(hit);
      EXPECT_EQ(hit->instance, instance);
      EXPECT_EQ(hit->mesh, mesh);
      EXPECT_NEAR(hit->distance, distance, 1e-5);
    };
    meets({0, 0, 5}, 0, 0, 4);
    meets({0, 2, 5}, 0, 1, 4.7);
    meets({5, 0, 5}, 1, 0, 2);
    meets({5, 4, 5}, 1, 1, 3.4);
    meets({9, 0, 5}, 2, 0, 4);
    meets({9, -2, 5}, 2, 1, 4.7);
  }
}

TEST(Bvh, WhatIsSmallIsCopiedAndWhatIsLargeIsShared) {
  EXPECT_EQ(hierarchy_bytes({2, 4}, 2), 2 * hierarchy_bytes({2, 4}, 1));
  EXPECT_LT(hierarchy_bytes({1000, 1000}, 1000), 10 * hierarchy_bytes({1000, 1000}, 1));
  EXPECT_EQ(hierarchy_bytes({1000, 1000}, 0), 0U);
}

TEST(Bvh, AHitOfSharedTrianglesIsOfTheMeshThatIsDrawn) {
  Scene scene = scene_of(sphere());
  scene.instances.clear();
  scene.materials.resize(3);
  scene.materials[2].double_sided = true;  // treated in another way
  for (std::uint32_t i = 1; i < 3; ++i) {
    scene.meshes.push_back(scene.meshes[0]);
    scene.meshes.back().material = i;
  }
  for (std::uint32_t i = 0; i < 60; ++i) {
    scene.instances.push_back({i % 3, moved(3 * static_cast<float>(i), 0, 0)});
  }
  EXPECT_THAT(group_instances(scene).shared, testing::SizeIs(2));
  const Bvh bvh = bvh_of(scene);
  for (std::uint32_t i = 0; i < 60; ++i) {
    const auto hit = bvh.intersect({{3.0 * i, 0, 5}, {0, 0, -1}}, 0);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->instance, i);
    EXPECT_EQ(hit->mesh, i % 3);
  }
}

// A hierarchy of triangles in one place would be a list.
TEST(Bvh, TrianglesThatRepeatOthersAreLeftOut) {
  Mesh mesh = quad();
  for (int i = 0; i < 3; ++i) mesh.triangles.push_back({0, 1, 2});
  mesh.triangles.push_back({1, 2, 0});  // begins at another corner
  EXPECT_THAT(find_repeats(mesh.triangles, mesh.positions), testing::ElementsAre(2, 3, 4));
  const Mesh ball = sphere();
  EXPECT_THAT(find_repeats(ball.triangles, ball.positions), testing::IsEmpty());
  Scene scene = scene_of(mesh);
  scene.materials[0].double_sided = true;
  const auto hit = bvh_of(scene).intersect({{0.5F, -0.5F, 5}, {0, 0, -1}}, 0);
  ASSERT_TRUE(hit);
  EXPECT_LT(hit->triangle, 6U);
  scene.meshes[0] = sphere();
  scene.meshes[0].material = 0;
  scene.instances.assign(50, scene.instances[0]);
  EXPECT_THAT(group_instances(scene).instanced, testing::SizeIs(1));
  scene.materials[0].alpha_mode = AlphaMode::blend;
  EXPECT_THAT(group_instances(scene).instanced, testing::SizeIs(50)) << "each layer counts";
}

// The inside of a volume is found by counting surfaces: no ray passes between two triangles.
TEST(Bvh, NothingSlipsOutOfAVolume) {
  SceneMaterial material;
  material.double_sided = true;
  material.factors.thickness = 1;
  const Scene scene = scene_of(cube(0.7F), material);
  const Bvh bvh = bvh_of(scene);
  const Mesh& mesh = scene.meshes[0];
  int lost = 0;
  for (std::uint32_t i = 0; i < 1U << 17U; ++i) {
    const auto random = [i](std::uint32_t number) {
      return static_cast<double>(unit_float(mix_bits(i, number)));
    };
    const Vec3d from = Vec3d(random(0), random(1), random(2)) * 0.6 - Vec3d(0.3, 0.3, 0.3);
    const auto& t = mesh.triangles[i % mesh.triangles.size()];
    const double along = random(3);
    const Vec3d edge =
        to_vec(mesh.positions[t[0]]) * along + to_vec(mesh.positions[t[1]]) * (1 - along);
    if (!bvh.intersect({from, normalize(edge - from)}, 0)) ++lost;
  }
  EXPECT_EQ(lost, 0);
}

}  // namespace
}  // namespace gltfx::render
