// SPDX-License-Identifier: Apache-2.0
// Small files that ask for much: what is the same is there once, and there is a limit to the rest.
#include <functional>
#include <ostream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "pipeline/baking.hpp"
#include "pipeline/scene_asset.hpp"
#include "render/bvh_groups.hpp"

namespace gltfx::test {
namespace {

using render::quad;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

// A mesh of n times the same primitive; `change` makes a joint or a target of it.
using Change = std::function<void(AssetText&, Json&)>;
int mesh_of(AssetText& asset, int n, const Change& change = {}) {
  const int mesh = asset.mesh(quad(), asset.material(plastic()));
  Json& primitives = asset.json()["meshes"][static_cast<std::size_t>(mesh)]["primitives"];
  Json primitive = primitives[0];
  if (change) change(asset, primitive);
  asset.json()["meshes"][static_cast<std::size_t>(mesh)]["primitives"] =
      std::vector<Json>(static_cast<std::size_t>(n), primitive);
  return mesh;
}

void nodes(AssetText& asset, int n, const std::function<Json(int)>& node) {
  for (int i = 0; i < n; ++i) asset.node(node(i));
}

void add_target(AssetText& asset, Json& primitive) {
  primitive["targets"] = Json::array({Json::object(
      {{"POSITION", asset.positions({{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}})}})});
}

void add_joints(AssetText& asset, Json& primitive) {
  primitive["attributes"]["JOINTS_0"] =
      asset.accessor("VEC4", 5121, 4, packed(std::vector<std::array<std::uint8_t, 4>>(4)));
  primitive["attributes"]["WEIGHTS_0"] =
      asset.accessor("VEC4", 5126, 4, packed(std::vector<std::array<float, 4>>(4, {1, 0, 0, 0})));
}

// n primitives in n nodes, in a row.
void primitives_in_nodes(AssetText& asset, int n) {
  const int mesh = mesh_of(asset, n);
  nodes(asset, n, [mesh](int i) { return Json{{"mesh", mesh}, {"translation", {3 * i, 0, 0}}}; });
}
void in_one_place(AssetText& asset, int n) {
  const int mesh = mesh_of(asset, n);
  nodes(asset, n, [mesh](int) { return Json{{"mesh", mesh}}; });
}
void shining(AssetText& asset, int n) {
  primitives_in_nodes(asset, n);
  asset.json()["materials"][0]["emissiveFactor"] = {1, 1, 1};
}
void poses(AssetText& asset, int n) {
  const int mesh = mesh_of(asset, n, add_target);
  nodes(asset, n, [mesh, n](int i) {
    return Json{{"mesh", mesh}, {"weights", Json::array({(i + 1.0) / n})}};
  });
}
void skins(AssetText& asset, int n) {
  const int mesh = mesh_of(asset, n, add_joints);
  for (int i = 0; i < n; ++i) asset.add("skins", {{"joints", Json::array({i})}});
  nodes(asset, n, [mesh](int i) { return Json{{"mesh", mesh}, {"skin", i}}; });
}

render::Scene built(const std::function<void(AssetText&, int)>& fill, int n,
                    const SceneOptions& options = {}) {
  AssetText asset;
  fill(asset, n);
  return scene_of_text(asset.text(), options);
}

// n meshes of one sphere, each with a material of its own, in a row.
void painted_alike(AssetText& asset, int n) {
  const int first = asset.mesh(render::sphere(), asset.material(plastic()));
  for (int i = 0; i < n; ++i) {
    const int color = asset.material(dielectric({i % 2, (i + 1) % 2, 0.5, 1}, 0.5));
    Json mesh = asset.json()["meshes"][static_cast<std::size_t>(first)];
    mesh["primitives"][0]["material"] = color;
    asset.node({{"mesh", asset.add("meshes", mesh)}, {"translation", {3 * i, 0, 0}}});
  }
}

TEST(BakeGrowth, MeshesOfTheSameAccessorsAreKeptOnce) {
  SceneOptions options;
  options.free_bytes = std::uint64_t{4} << 20U;  // a tenth of 400 spheres
  const render::Scene scene = built(painted_alike, 400, options);
  EXPECT_THAT(scene.notes, testing::IsEmpty());
  ASSERT_THAT(scene.meshes, SizeIs(400));
  ASSERT_THAT(scene.instances, SizeIs(400));
  EXPECT_EQ(scene.meshes[7].positions.data(), scene.meshes[0].positions.data());
  EXPECT_NE(scene.meshes[7].material, scene.meshes[0].material);
  const render::Groups groups = render::group_instances(scene);
  EXPECT_THAT(groups.shared, SizeIs(1));
  EXPECT_THAT(groups.instanced, SizeIs(400));
}

TEST(BakeGrowth, PrimitivesOfAMeshShareItsInstances) {
  const render::Scene scene = built(primitives_in_nodes, 60);
  EXPECT_THAT(scene.meshes, SizeIs(60));
  ASSERT_THAT(scene.instances, SizeIs(60));
  for (const render::Instance& each : scene.instances) {
    EXPECT_EQ(each.mesh, 0U);
    EXPECT_EQ(each.count, 60U);
  }
}

// One of n and one of 4 n: geometry and instances of the hierarchy grow as the file does.
TEST(BakeGrowth, TheHierarchyGrowsWithTheFile) {
  for (const auto& fill : {primitives_in_nodes, in_one_place, shining}) {
    std::vector<std::size_t> sizes;
    for (const int n : {100, 400}) {
      const render::Groups groups = render::group_instances(built(fill, n));
      std::size_t size = groups.instanced.size();
      for (const auto& group : groups.flat) size += group.parts.size();
      for (const auto& treated : groups.shared) {
        for (const auto& group : treated) size += group.parts.size();
      }
      sizes.push_back(size);
    }
    EXPECT_LE(sizes[1], 4 * sizes[0]);
    EXPECT_LE(sizes[1], 800U);
  }
}

TEST(BakeGrowth, WhatJointsMoveStandsApartFromTheRest) {
  const render::Scene scene = built(
      [](AssetText& asset, int) {
        const int mesh = mesh_of(asset, 3);
        add_joints(asset, asset.json()["meshes"][0]["primitives"][1]);
        const int joint = asset.node({{"translation", {5, 0, 0}}});
        asset.add("skins", {{"joints", Json::array({joint})}});
        asset.node({{"mesh", mesh}, {"skin", 0}, {"translation", {0, 7, 0}}});
      },
      0);
  ASSERT_THAT(scene.instances, SizeIs(2));
  EXPECT_EQ(scene.instances[0].count, 2U);
  EXPECT_EQ(scene.instances[0].to_world[1][3], 7);
  EXPECT_EQ(scene.instances[1].count, 1U);
  EXPECT_EQ(scene.instances[1].to_world, render::kIdentity);
  EXPECT_FLOAT_EQ(scene.meshes[scene.instances[1].mesh].positions[0][0], 4);
}

TEST(BakeGrowth, InstancesEndWithTheMemory) {
  SceneOptions options;
  options.free_bytes = 40000;
  const render::Scene scene = built(
      [](AssetText& asset, int n) {
        const int mesh = mesh_of(asset, 2);
        nodes(asset, n, [mesh](int i) {
          return Json{{"mesh", mesh}, {"translation", {3 * i, 0, 0}}};
        });
      },
      1000, options);
  EXPECT_GT(scene.instances.size(), 40U);
  EXPECT_LT(scene.instances.size(), 100U) << "an instance takes some 700 bytes";
  EXPECT_THAT(scene.notes, ElementsAre(HasSubstr("drawn more often than memory allows")));
}

TEST(BakeGrowth, JointsEndWithTheMemory) {
  SceneOptions options;
  options.free_bytes = 20000;
  const render::Scene scene = built(
      [](AssetText& asset, int n) {
        const int mesh = mesh_of(asset, 1, add_joints);
        asset.add("skins", {{"joints", std::vector<int>(static_cast<std::size_t>(n), 0)}});
        asset.node({{"mesh", mesh}, {"skin", 0}});
      },
      1000, options);
  EXPECT_THAT(scene.notes, Contains(HasSubstr("Skin 0 asks for more memory")));
}

struct GrowthCase {
  const char* name;
  void (*fill)(AssetText& asset, int n);
  bool limited;
};
void PrintTo(const GrowthCase& shown, std::ostream* out) { *out << shown.name; }

class BakeGrowthOf : public Baking, public testing::WithParamInterface<GrowthCase> {};

// Of some 100 kB each; what they ask for is 30,000 times as much.
TEST_P(BakeGrowthOf, IsDrawnOrLimited) {
  options.cameras.clear();
  options.samples = 1;
  AssetText asset;
  GetParam().fill(asset, 1200);
  const BakeReport done = report(asset);
  EXPECT_EQ(done.problem, BakeProblem::none) << done.error;
  if (GetParam().limited) {
    EXPECT_THAT(done.notes, Contains(HasSubstr("more poses than memory allows")));
  } else {
    EXPECT_THAT(done.notes, testing::IsEmpty());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Constructs, BakeGrowthOf,
    testing::Values(GrowthCase{"primitives_in_nodes", primitives_in_nodes, false},
                    GrowthCase{"in_one_place", in_one_place, false},
                    GrowthCase{"shining", shining, false}, GrowthCase{"poses", poses, true},
                    GrowthCase{"skins", skins, true}),
    [](const auto& chosen) { return std::string(chosen.param.name); });

}  // namespace
}  // namespace gltfx::test
