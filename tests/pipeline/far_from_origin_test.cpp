// SPDX-License-Identifier: Apache-2.0
// Assets at geographic coordinates look as they do around the origin.
#include <cmath>
#include <cstdlib>
#include <functional>

#include <gmock/gmock.h>

#include "pipeline/baking.hpp"

namespace gltfx::test {
namespace {

using render::cube;
using testing::Contains;
using testing::HasSubstr;

using Place = std::array<double, 3>;
constexpr Place kUtm{500000.25, 4649776.5, 120.125};
constexpr Place kMercator{12958095.1256, 35.0, -4865499.4712};

/// Adds an asset whose parts lie around a place.
using Fill = std::function<void(AssetText&, const Place&)>;

class FarFromOrigin : public Baking {
 protected:
  FarFromOrigin() {
    options.cameras = {""};
    options.sizes = {{48, 48}};
  }

  std::vector<std::uint8_t> picture(const Fill& fill, const Place& place) {
    AssetText asset;
    fill(asset, place);
    const BakeReport done = report(asset);
    EXPECT_EQ(done.problem, BakeProblem::none) << done.error;
    EXPECT_TRUE(done.notes.empty() || coarse_) << done.notes.front();
    return done.pixels.bytes;
  }

  /// The mean difference of bytes from the picture around the origin.
  double difference(const Fill& fill, const Place& place) {
    const auto near = picture(fill, {0, 0, 0});
    const auto far = picture(fill, place);
    if (near.size() != far.size() || near.empty()) return 255;
    double sum = 0;
    for (std::size_t i = 0; i < near.size(); ++i) sum += std::abs(int{near[i]} - int{far[i]});
    return sum / static_cast<double>(near.size());
  }

  bool coarse_ = false;  ///< positions are rounded to more than a thousandth of their extent
};

// A large cube and a small one beside it, in the space of their parent.
Json cubes(AssetText& asset) {
  const int large = asset.mesh(cube(0.5F), asset.material(plastic()));
  const int small = asset.mesh(cube(0.15F), asset.material(dielectric({0.1, 0.3, 0.8, 1}, 0.5)));
  return {asset.add("nodes", {{"mesh", large}}),
          asset.add("nodes", {{"mesh", small}, {"translation", {0.65, -0.35, 0.2}}})};
}

TEST_F(FarFromOrigin, TranslationsAreReadInDoublePrecision) {
  const Fill translated = [](AssetText& asset, const Place& place) {
    asset.node({{"children", cubes(asset)}, {"translation", place}});
  };
  const Fill matrix = [](AssetText& asset, const Place& place) {
    asset.node({{"children", cubes(asset)},
                {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, place[0], place[1], place[2], 1}}});
  };
  // Each cube has a place of its own: their distance is less than a step of single precision.
  const Fill apart = [](AssetText& asset, const Place& place) {
    const int mesh = asset.mesh(cube(0.25F), asset.material(plastic()));
    for (const double x : {0.0, 0.6}) {
      asset.node({{"mesh", mesh}, {"translation", {place[0] + x, place[1], place[2]}}});
    }
  };
  for (const Place& place : {kUtm, kMercator}) {
    EXPECT_LT(difference(translated, place), 1);
    EXPECT_LT(difference(matrix, place), 1);
    EXPECT_LT(difference(apart, place), 1);
  }
}

TEST_F(FarFromOrigin, LightsCamerasAndFramesAreThereToo) {
  const Fill scene = [](AssetText& asset, const Place& place) {
    asset.node({{"children", cubes(asset)}, {"translation", place}});
    asset.light({{"type", "point"}, {"intensity", 30}},
                {{"translation", {place[0] + 1, place[1] + 2, place[2] + 1}}});
    asset.camera({{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.01}}}},
                 {{"translation", {place[0], place[1], place[2] + 3}}});
  };
  options.lights = BakeLights::asset;
  options.cameras = {"0"};
  EXPECT_LT(difference(scene, kMercator), 1);
  options.cameras = {""};
  options.frame = "1";
  EXPECT_LT(difference(scene, kMercator), 1);
}

TEST_F(FarFromOrigin, SkinsInstancesAndAnimationsAreThereToo) {
  const Fill skinned = [](AssetText& asset, const Place& place) {
    const int mesh = asset.mesh(cube(0.5F), asset.material(plastic()));
    Json& attributes = asset.json()["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] =
        asset.accessor("VEC4", 5121, 8, packed(std::vector<std::array<std::uint8_t, 4>>(8)));
    attributes["WEIGHTS_0"] =
        asset.accessor("VEC4", 5126, 8, packed(std::vector<std::array<float, 4>>(8, {1, 0, 0, 0})));
    const int joint = asset.node({{"translation", place}, {"scale", {1, 2, 1}}});
    asset.add("skins", {{"joints", {joint}}});
    asset.node({{"mesh", mesh}, {"skin", 0}});
  };
  const Fill copies = [](AssetText& asset, const Place& place) {
    asset.uses("EXT_mesh_gpu_instancing");
    const int mesh = asset.mesh(cube(0.2F), asset.material(plastic()));
    const int places = asset.accessor("VEC3", 5126, 2, floats({0, 0, 0, 0.5F, 0, 0.25F}));
    Json node{{"mesh", mesh}, {"translation", place}};
    node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
    asset.node(node);
  };
  const Fill animated = [](AssetText& asset, const Place& place) {
    const int root = asset.node({{"children", cubes(asset)}, {"translation", place}});
    const int times = asset.accessor("SCALAR", 5126, 1, floats({0}), {{"min", {0}}, {"max", {0}}});
    const int turned = asset.accessor("VEC4", 5126, 1, floats({0, 0.5F, 0, 0.8660254F}));
    asset.add(
        "animations",
        {{"samplers", {{{"input", times}, {"output", turned}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", root}, {"path", "rotation"}}}}}}});
  };
  for (const Fill& fill : {skinned, copies}) EXPECT_LT(difference(fill, kUtm), 1);
  options.animation = "0";
  EXPECT_LT(difference(animated, kUtm), 1);
}

// Positions that single precision holds, in a mesh that is moved back or not.
TEST_F(FarFromOrigin, VerticesMayBeFar) {
  const Fill vertices = [](AssetText& asset, const Place& place) {
    for (const auto& [half, x] : {std::pair(512.0F, 0.0F), std::pair(256.0F, 768.0F)}) {
      render::Mesh mesh = cube(half);
      for (Float3& p : mesh.positions) {
        p[0] += x;
        for (std::size_t i = 0; i < 3; ++i) p[i] += static_cast<float>(place[i]);
      }
      asset.draw(mesh, plastic());
      asset.draw(mesh, plastic(), {{"translation", {-place[0], -place[1] + 2000, -place[2]}}});
    }
  };
  const Fill here = [&vertices](AssetText& asset, const Place& place) {
    AssetText all;
    vertices(all, place);
    asset = all;
    for (Json& node : asset.json()["nodes"]) {
      if (!node.contains("translation")) node["translation"] = {-place[0], -place[1], -place[2]};
    }
  };
  EXPECT_LT(difference(here, {500000, 4649776, 64}), 1);
}

// Displacements are small beside the steps of their vertices; a vertex may even be nothing else.
TEST_F(FarFromOrigin, MorphTargetsAreThereToo) {
  const auto morphed = [](float half, float displacement) -> Fill {
    return [=](AssetText& asset, const Place& place) {
      const render::Mesh shape = cube(1);
      render::Mesh base = cube(half);
      for (Float3& p : base.positions) {
        for (std::size_t i = 0; i < 3; ++i) p[i] += static_cast<float>(place[i]);
      }
      std::vector<Float3> moves(shape.positions.begin(), shape.positions.end());
      for (Float3& move : moves) {
        for (std::size_t i = 0; i < 3; ++i) move[i] *= displacement * static_cast<float>(i + 1);
      }
      const int mesh = asset.mesh(base, asset.material(plastic()));
      Json& primitive = asset.json()["meshes"][0]["primitives"][0];
      primitive["targets"] = {{{"POSITION", asset.positions(moves)}}};
      asset.json()["meshes"][0]["weights"] = {0.75};
      asset.node({{"mesh", mesh}});
    };
  };
  coarse_ = true;
  const Place place{1000000, 500000, 64};
  EXPECT_LT(difference(morphed(0.125F, 0.03F), place), 1);
  EXPECT_LT(difference(morphed(0, 0.05F), place), 1);
}

TEST_F(FarFromOrigin, WhatPositionsDoNotHoldIsNoted) {
  AssetText asset;
  render::Mesh mesh = cube(0.5F);
  for (Float3& p : mesh.positions) p[0] += 4649776.25F;
  asset.draw(mesh, plastic());
  EXPECT_THAT(report(asset).notes, Contains(HasSubstr("rounds them to steps of 0.5")));
}

// The scene moves with its origin, not the camera.
TEST_F(FarFromOrigin, ComparedAssetsAreSeenFromOnePlace) {
  const auto write = [this](const char* name, double more) {
    AssetText asset;
    asset.node({{"children", cubes(asset)}, {"translation", kUtm}});
    const int mesh = asset.mesh(cube(0.01F), asset.material(plastic()));
    for (int i = 0; i < 3; ++i) {
      asset.node({{"mesh", mesh}, {"translation", {kUtm[0] + more, kUtm[1], kUtm[2]}}});
    }
    return folder.write(name, asset.text()).native();
  };
  const BakeComparison compared =
      bake_comparison(write("a.gltf", 0), write("b.gltf", 0.4), options);
  EXPECT_TRUE(compared.error.empty());
  EXPECT_GT(compared.psnr, 30);
}

}  // namespace
}  // namespace gltfx::test
