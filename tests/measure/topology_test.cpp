// SPDX-License-Identifier: Apache-2.0
// The surface of a mesh: values by construction, and what has no value.
#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "measure/surface_asset.hpp"

namespace gltfx::measure {
namespace {

using nlohmann::json;
using test::asset_of;
using test::Body;
using test::both;
using test::cube;
using test::measured;
using test::value;

const Body kQuad{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 3}};

// Compares the named values of the first mesh.
void expect_values(const Measurements& taken, const json& expected, const std::string& where) {
  for (const auto& [name, wanted] : expected.items()) {
    const json found = value(taken, MeasureScope::mesh, name);
    if (wanted.is_number() && found.is_number()) {
      EXPECT_NEAR(found.get<double>(), wanted.get<double>(), 1e-9) << where << ' ' << name;
    } else {
      EXPECT_EQ(found, wanted) << where << ' ' << name;
    }
  }
}

void expect_shape(const Body& body, const json& expected, const std::string& where) {
  expect_values(measured(asset_of({body})), expected, where);
}

// Why a measure of the first mesh has no value.
MeasureReason reason_of(const Measurements& taken, std::string_view name) {
  const auto& found = taken.find(MeasureScope::mesh, name)->values.at(0);
  return taken.reasons.at(std::get<NotMeasured>(found).reason);
}

Body with_corners(Body body, const std::vector<std::uint32_t>& corners) {
  body.corners = corners;
  return body;
}

TEST(Topology, ACubeIsAClosedBody) {
  expect_shape(cube(),
               {{"surface-area", 6},
                {"volume", 1},
                {"shells", 1},
                {"open-edges", 0},
                {"non-manifold-edges", 0},
                {"flipped-edges", 0},
                {"closed", true},
                {"hard-edges", 12},
                {"duplicate-triangles", 0},
                {"degenerate-triangles", 0},
                {"non-manifold-vertices", 0}},
               "cube");
}

TEST(Topology, AHoleOpensEdges) {
  Body open = cube();
  open.corners.resize(30);  // without one side
  expect_shape(open, {{"open-edges", 4}, {"closed", false}, {"volume", nullptr}, {"hard-edges", 8}},
               "box");
  EXPECT_EQ(reason_of(measured(asset_of({open})), "volume").text, "The mesh is not closed.");
}

TEST(Topology, CubesThatTouch) {
  expect_shape(both(cube(), cube(3)), {{"shells", 2}, {"volume", 2}, {"closed", true}}, "apart");
  // Along an edge: one edge has four triangles.
  expect_shape(both(cube(), cube(1, 1)),
               {{"shells", 1},
                {"non-manifold-edges", 1},
                {"open-edges", 0},
                {"non-manifold-vertices", 0},
                {"closed", false}},
               "edge");
  // In a corner: no edge is shared there.
  expect_shape(both(cube(), cube(1, 1, 1)),
               {{"shells", 1},
                {"non-manifold-edges", 0},
                {"non-manifold-vertices", 1},
                {"closed", true},
                {"volume", 2}},
               "corner");
}

TEST(Topology, ACavityIsNoVolume) {
  Body outer = cube(), inner = cube();
  for (auto& place : outer.places) {
    for (float& each : place) each = each * 4 - 1;
  }
  for (std::size_t i = 0; i < inner.corners.size(); i += 3) {
    std::swap(inner.corners[i], inner.corners[i + 1]);
  }
  expect_shape(both(outer, inner), {{"volume", 63}, {"closed", true}, {"shells", 2}}, "cavity");
  expect_shape(inner, {{"volume", 1}, {"flipped-edges", 0}}, "inside out");
}

TEST(Topology, ATurnedTriangleFlipsItsEdges) {
  Body body = cube();
  std::swap(body.corners[0], body.corners[1]);
  expect_shape(body, {{"flipped-edges", 3}, {"open-edges", 0}, {"closed", false}}, "turned");
}

TEST(Topology, TrianglesThatCountAsDuplicatesOrDegenerate) {
  // The same three vertices in three orders.
  const Body twice = with_corners(kQuad, {0, 1, 2, 2, 0, 1, 1, 0, 2, 0, 2, 3});
  expect_shape(twice, {{"duplicate-triangles", 2}, {"non-manifold-edges", 3}, {"surface-area", 2}},
               "twice");
  // A vertex twice, two vertices at one place, three on a line.
  Body thin = with_corners(kQuad, {0, 1, 2, 0, 2, 3, 0, 0, 1, 1, 4, 2, 0, 5, 1});
  thin.places.push_back({1, 0, 0});
  thin.places.push_back({0.5F, 0, 0});
  expect_shape(thin, {{"degenerate-triangles", 3}, {"open-edges", 4}, {"surface-area", 1}}, "thin");
  // A sliver is a triangle: its height is 1e-6 of its side.
  const Body sliver{{{0, 0, 0}, {1, 0, 0}, {0.5F, 1e-6F, 0}}, {}};
  expect_shape(sliver, {{"degenerate-triangles", 0}, {"open-edges", 3}}, "sliver");
}

TEST(Topology, AMeshWhoseTrianglesHaveNoArea) {
  const Body body = with_corners(kQuad, {0, 0, 1});
  expect_shape(body,
               {{"degenerate-triangles", 1},
                {"shells", 0},
                {"open-edges", 0},
                {"closed", nullptr},
                {"volume", nullptr}},
               "none");
}

TEST(Topology, AnglesCountFromTheLimit) {
  // A roof of two rectangles whose normals enclose 90 degrees, and flatter ones.
  const auto roof = [](double degrees) {
    const double half = degrees * std::acos(-1.0) / 360;
    const auto low = static_cast<float>(-std::sin(half)), side = static_cast<float>(std::cos(half));
    Body body{
        {{0, 0, 0}, {0, 0, 1}, {side, low, 0}, {side, low, 1}, {-side, low, 0}, {-side, low, 1}},
        {0, 1, 2, 1, 3, 2, 0, 4, 1, 1, 4, 5}};
    return asset_of({body});
  };
  const auto hard = [&](double degrees, double limit) {
    Request request;
    request.parameters.hard_angle = limit;
    return value(measured(roof(degrees), request), MeasureScope::mesh, "hard-edges");
  };
  EXPECT_EQ(hard(90, 90), 1);
  EXPECT_EQ(hard(89.995, 90), 1) << "within the tolerance";
  EXPECT_EQ(hard(89.98, 90), 0);
  EXPECT_EQ(hard(30, 30), 1);
  EXPECT_EQ(hard(29.9, 30), 0);
  EXPECT_EQ(hard(45, 0), 3) << "also the edges inside the rectangles";
}

TEST(Topology, PrimitivesOfAMeshAreOneSurface) {
  Body bottom = cube(), rest = cube();
  bottom.corners.resize(6);
  rest.corners.erase(rest.corners.begin(), rest.corners.begin() + 6);
  const Body line{{{5, 0, 0}, {6, 0, 0}}, {}, 1};
  const Measurements taken = measured(asset_of({bottom, line, rest}));
  expect_values(taken, {{"closed", true}, {"hard-edges", 12}, {"shells", 1}}, "primitives");
}

TEST(Topology, MeshesAreApart) {
  auto asset = asset_of({cube()});
  gltfx::test::AssetBuilder::Json sheet, same;
  sheet["primitives"].push_back(test::add_primitive(asset, kQuad));
  same["primitives"].push_back(asset.json["meshes"][0]["primitives"][0]);
  asset.add("meshes", sheet);
  asset.add("meshes", same);
  const Measurements taken = measured(asset);
  EXPECT_EQ(value(taken, MeasureScope::mesh, "open-edges", 1), 4);
  EXPECT_EQ(value(taken, MeasureScope::mesh, "volume", 2), 1);
  EXPECT_EQ(value(taken, MeasureScope::asset, "open-edges"), 4);
  EXPECT_EQ(value(taken, MeasureScope::asset, "hard-edges"), 24);
  EXPECT_EQ(value(taken, MeasureScope::asset, "closed"), false);
}

TEST(Topology, TrianglesThatAreNotFiniteAreLeftOut) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Body body = kQuad;
    body.places[3][2] = bad;
    expect_shape(body, {{"open-edges", 3}, {"surface-area", 0.5}, {"degenerate-triangles", 0}},
                 std::to_string(bad));
  }
}

TEST(Topology, LinesHaveNoSurface) {
  const Measurements taken = measured(asset_of({Body{{{0, 0, 0}, {1, 0, 0}}, {}, 1}}));
  EXPECT_FALSE(reason_of(taken, "shells").fault);
  EXPECT_EQ(reason_of(taken, "shells").text, "The mesh has no triangles.");
}

TEST(Topology, MissingBytesAreAFault) {
  for (const char* member : {"bufferViews", "accessors"}) {
    auto asset = asset_of({cube()});
    asset.json[member][0]["byteOffset"] = 100000;
    const Measurements taken = measured(asset);
    EXPECT_TRUE(reason_of(taken, "open-edges").fault) << member;
    EXPECT_EQ(value(taken, MeasureScope::asset, "open-edges"), nullptr) << member;
  }
}

// A sparse accessor says how many elements it has, and stores few.
TEST(Topology, VerticesThatAreNotStoredTakeNoMemory) {
  auto asset = asset_of({kQuad});
  const auto one = asset.view(gltfx::test::packed<std::uint32_t>({0}));
  const auto place = asset.view(gltfx::test::floats({1, 2, 3}));
  asset.json["accessors"][0].erase("bufferView");
  asset.json["accessors"][0]["count"] = 4'000'000'000U;
  asset.json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", one}, {"componentType", 5125}}},
      {"values", {{"bufferView", place}}}};
  const Measurements taken = measured(asset);
  EXPECT_TRUE(reason_of(taken, "open-edges").fault);
}

}  // namespace
}  // namespace gltfx::measure
