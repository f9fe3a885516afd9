// SPDX-License-Identifier: Apache-2.0
// What leaves the measures of a shape alike: turning, scaling, mirroring, another storage of the
// same triangles.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/support/draco_encoder.hpp"
#include "measure/surface_asset.hpp"

namespace gltfx::measure {
namespace {

using nlohmann::json;
using test::Body;
using test::both;
using test::cube;

constexpr std::array<const char*, 11> kShape{"closed",
                                             "degenerate-triangles",
                                             "duplicate-triangles",
                                             "flipped-edges",
                                             "hard-edges",
                                             "non-manifold-edges",
                                             "open-edges",
                                             "non-manifold-vertices",
                                             "surface-area",
                                             "shells",
                                             "volume"};

// Bodies with each flaw.
std::vector<Body> bodies() {
  Body open = cube(), turned = cube(), doubled = cube(), thin = cube();
  open.corners.resize(33);
  std::swap(turned.corners[0], turned.corners[1]);
  doubled.corners.insert(doubled.corners.end(), {3, 2, 0});
  thin.corners.insert(thin.corners.end(), {0, 0, 1});
  return {cube(),
          open,
          turned,
          doubled,
          thin,
          both(cube(), cube(1, 1)),
          both(cube(), cube(1, 1, 1)),
          both(cube(), cube(2))};
}

json shape_of(const gltfx::test::AssetBuilder& asset) {
  const Measurements taken = test::measured(asset);
  json shape;
  for (const char* name : kShape) shape[name] = test::value(taken, MeasureScope::mesh, name);
  return shape;
}

void expect_alike(const json& shape, json expected, double scale, const std::string& where) {
  for (const char* name : {"surface-area", "volume"}) {
    if (!expected[name].is_number() || !shape[name].is_number()) continue;
    const double power = std::pow(scale, name[0] == 's' ? 2 : 3);
    EXPECT_NEAR(shape[name].get<double>(), expected[name].get<double>() * power, 1e-5 * power)
        << where << ' ' << name;
    expected[name] = shape[name];
  }
  EXPECT_EQ(shape, expected) << where;
}

void expect_alike_after(const std::function<void(Body&)>& change, double scale = 1) {
  std::size_t number = 0;
  for (const Body& body : bodies()) {
    Body changed = body;
    change(changed);
    expect_alike(shape_of(test::asset_of({changed})), shape_of(test::asset_of({body})), scale,
                 "body " + std::to_string(number++));
  }
}

TEST(ShapeProperties, Turning) {
  for (const double angle : {0.3, 1.0, 2.5}) {
    const auto sine = static_cast<float>(std::sin(angle)),
               cosine = static_cast<float>(std::cos(angle));
    expect_alike_after([&](Body& body) {
      for (auto& place : body.places) {
        const auto [x, y, z] = place;
        const float turned = sine * x + cosine * y;
        place = {cosine * x - sine * y, cosine * turned - sine * z, sine * turned + cosine * z};
      }
    });
  }
}

TEST(ShapeProperties, Scaling) {
  for (const float scale : {1e-6F, 0.37F, 3e7F}) {
    expect_alike_after(
        [&](Body& body) {
          for (auto& place : body.places) {
            for (float& each : place) each *= scale;
          }
        },
        static_cast<double>(scale));
  }
}

TEST(ShapeProperties, Mirroring) {
  expect_alike_after([](Body& body) {
    for (auto& place : body.places) place[0] = -place[0];
  });
}

TEST(ShapeProperties, SplittingVertices) {
  expect_alike_after([](Body& body) {
    std::vector<std::array<float, 3>> places;
    for (const std::uint32_t corner : body.corners) places.push_back(body.places[corner]);
    body.places = places;
    body.corners.clear();
  });
}

TEST(ShapeProperties, OrderOfVerticesAndTriangles) {
  std::mt19937 random(11);
  expect_alike_after([&](Body& body) {
    std::vector<std::uint32_t> order(body.places.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), random);
    auto places = body.places;
    for (std::size_t i = 0; i < order.size(); ++i) places[order[i]] = body.places[i];
    body.places = places;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i < body.corners.size(); i += 3) {
      std::array<std::uint32_t, 3> triangle{order[body.corners[i]], order[body.corners[i + 1]],
                                            order[body.corners[i + 2]]};
      std::rotate(triangle.begin(), triangle.begin() + random() % 3, triangle.end());
      triangles.push_back(triangle);
    }
    std::shuffle(triangles.begin(), triangles.end(), random);
    body.corners.clear();
    for (const auto& triangle : triangles) {
      body.corners.insert(body.corners.end(), triangle.begin(), triangle.end());
    }
  });
}

TEST(ShapeProperties, Primitives) {
  for (const Body& body : bodies()) {
    std::vector<Body> parts;
    for (std::size_t i = 0; i < body.corners.size(); i += 12) {
      const std::size_t end = std::min(i + 12, body.corners.size());
      parts.push_back({body.places,
                       {body.corners.begin() + static_cast<std::ptrdiff_t>(i),
                        body.corners.begin() + static_cast<std::ptrdiff_t>(end)}});
    }
    expect_alike(shape_of(test::asset_of(parts)), shape_of(test::asset_of({body})), 1, "parts");
  }
}

TEST(ShapeProperties, StripsAndFansAreTriangles) {
  const std::vector<std::array<float, 3>> places{{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                                 {1, 1, 0}, {0, 2, 1}, {1, 2, 1}};
  const Body strip{places, {0, 1, 2, 3, 4, 5}, 5};
  const Body as_list{places, {0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5}};
  expect_alike(shape_of(test::asset_of({strip})), shape_of(test::asset_of({as_list})), 1, "strip");
  const Body fan{places, {0, 1, 3, 2, 4}, 6};
  const Body fan_as_list{places, {0, 1, 3, 0, 3, 2, 0, 2, 4}};
  expect_alike(shape_of(test::asset_of({fan})), shape_of(test::asset_of({fan_as_list})), 1, "fan");
}

TEST(ShapeProperties, NormalizedIntegers) {
  gltfx::test::AssetBuilder asset;
  std::string bytes;
  for (const auto& place : cube().places) {
    for (const float each : place) bytes += static_cast<char>(each > 0 ? 255 : 0);
    bytes += '\0';
  }
  const auto places =
      asset.accessor("VEC3", 5121, 8, bytes, {{"normalized", true}}, {{"byteStride", 4}});
  const auto corners = test::add_corners(asset, cube());
  asset.add("meshes",
            {{"primitives", {{{"attributes", {{"POSITION", places}}}, {"indices", corners}}}}});
  expect_alike(shape_of(asset), shape_of(test::asset_of({cube()})), 1, "integers");
}

TEST(ShapeProperties, DracoBitstreams) {
  for (const Body& body : {cube(), bodies()[1], both(cube(), cube(2))}) {
    for (const bool edgebreaker : {false, true}) {
      gltfx::test::DracoSource source;
      source.points = static_cast<std::uint32_t>(body.places.size());
      source.indices = body.corners;
      source.edgebreaker = edgebreaker;
      std::string bytes;
      for (const auto& place : body.places) {
        bytes += gltfx::test::floats({place[0], place[1], place[2]});
      }
      source.attributes.push_back({.bytes = bytes});
      gltfx::test::AssetBuilder asset;
      const auto stream = asset.view(gltfx::test::draco_bytes(source));
      const auto places = asset.accessor("VEC3", 5126, body.places.size(), {});
      const auto corners = asset.accessor("SCALAR", 5125, body.corners.size(), {});
      gltfx::test::AssetBuilder::Json primitive{{"attributes", {{"POSITION", places}}},
                                                {"indices", corners}};
      primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", stream},
                                                               {"attributes", {{"POSITION", 0}}}};
      gltfx::test::AssetBuilder::Json mesh;
      mesh["primitives"].push_back(primitive);
      asset.add("meshes", mesh);
      expect_alike(shape_of(asset), shape_of(test::asset_of({body})), 1,
                   edgebreaker ? "edgebreaker" : "sequential");
    }
  }
}

}  // namespace
}  // namespace gltfx::measure
