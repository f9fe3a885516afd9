// SPDX-License-Identifier: Apache-2.0
// Tangents: their direction, handedness, seams, and what must not matter.
#include "model/tangent_space.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gltfx::model {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::FloatNear;
using testing::IsEmpty;
using testing::SizeIs;

testing::Matcher<std::array<float, 4>> near_tangent(float x, float y, float z, float w) {
  return ElementsAre(FloatNear(x, 1e-5F), FloatNear(y, 1e-5F), FloatNear(z, 1e-5F), w);
}

bool generate(Geometry& geometry, std::uint64_t budget = 1U << 20U) {
  MemoryBudget left(budget);
  const Vectors<2> coordinates = geometry.tex_coords[0];
  return generate_tangents(geometry, coordinates, left);
}

// Two triangles in the plane z = 0; texture coordinates run to the right and, as images do, down.
Geometry square_geometry() {
  Geometry geometry;
  geometry.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  geometry.normals.assign(4, {0, 0, 1});
  geometry.tex_coords = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  geometry.triangles = {{0, 1, 2}, {0, 2, 3}};
  return geometry;
}

TEST(TangentSpace, FollowsUAndIsRightHanded) {
  Geometry geometry = square_geometry();
  ASSERT_TRUE(generate(geometry));
  EXPECT_THAT(geometry.tangents, SizeIs(4));
  EXPECT_THAT(geometry.tangents, Each(near_tangent(1, 0, 0, 1)));
}

TEST(TangentSpace, MirroredCoordinatesAreLeftHanded) {
  Geometry geometry = square_geometry();
  for (auto& uv : geometry.tex_coords[0]) uv[0] = -uv[0];
  ASSERT_TRUE(generate(geometry));
  EXPECT_THAT(geometry.tangents, Each(near_tangent(-1, 0, 0, -1)));
}

TEST(TangentSpace, ScaleOfCoordinatesDoesNotMatterButTheirTurnDoes) {
  Geometry geometry = square_geometry();
  for (auto& uv : geometry.tex_coords[0]) uv = {uv[1] * 0.01F, -uv[0] * 7};
  ASSERT_TRUE(generate(geometry));
  EXPECT_THAT(geometry.tangents, Each(near_tangent(0, -1, 0, 1)));
}

TEST(TangentSpace, LiesAcrossTheNormalOfTheVertex) {
  Geometry geometry = square_geometry();
  const float half = std::sqrt(0.5F);
  geometry.normals.assign(4, {half, 0, half});
  ASSERT_TRUE(generate(geometry));
  EXPECT_THAT(geometry.tangents, Each(near_tangent(half, 0, -half, 1)));
}

// Like an open book: two squares that share an edge along y.
Geometry book() {
  Geometry geometry;
  geometry.positions = {{-1, 0, 1}, {0, 0, 0}, {1, 0, 1}, {-1, 1, 1}, {0, 1, 0}, {1, 1, 1}};
  geometry.normals.assign(6, {0, 0, 1});
  geometry.tex_coords = {{{0, 1}, {1, 1}, {2, 1}, {0, 0}, {1, 0}, {2, 0}}};
  geometry.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  return geometry;
}

TEST(TangentSpace, SmoothEdgesShareATangent) {
  Geometry geometry = book();
  ASSERT_TRUE(generate(geometry));
  EXPECT_THAT(geometry.positions, SizeIs(6));
  EXPECT_THAT(geometry.tangents, Each(near_tangent(1, 0, 0, 1)));
}

TEST(TangentSpace, EqualVerticesCountAsOne) {
  // As before, but without any shared index.
  const Geometry shared = book();
  Geometry loose;
  loose.tex_coords.resize(1);
  for (const Triangle& triangle : shared.triangles) {
    const auto next = static_cast<std::uint32_t>(loose.positions.size());
    for (const std::uint32_t i : triangle) {
      loose.positions.push_back(shared.positions[i]);
      loose.normals.push_back(shared.normals[i]);
      loose.tex_coords[0].push_back(shared.tex_coords[0][i]);
    }
    loose.triangles.push_back({next, next + 1, next + 2});
  }
  // Turned a little, so that the two halves would disagree if nothing bound them.
  for (auto& uv : loose.tex_coords[0]) uv[1] += uv[0] > 1 ? 0.5F * (uv[0] - 1) : 0;
  Geometry indexed = shared;
  for (auto& uv : indexed.tex_coords[0]) uv[1] += uv[0] > 1 ? 0.5F * (uv[0] - 1) : 0;
  ASSERT_TRUE(generate(loose));
  ASSERT_TRUE(generate(indexed));
  std::size_t corner = 0;
  for (const Triangle& triangle : indexed.triangles) {
    for (const std::uint32_t i : triangle) {
      const auto& [x, y, z, w] = indexed.tangents[i];
      EXPECT_THAT(loose.tangents[corner++], near_tangent(x, y, z, w));
    }
  }
}

TEST(TangentSpace, ACornerCountsByItsAngle) {
  // Three triangles around vertex 0: two with the angle of 45 degrees whose u runs along x, one of
  // 90 degrees with coordinates that are sheared so that its u runs along the diagonal.
  Geometry geometry;
  geometry.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 0, 0}};
  geometry.normals.assign(5, {0, 0, 1});
  geometry.tex_coords = {{{0, 0}, {1, 0}, {1, -1}, {0, -1}, {-1, 1}}};
  geometry.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  ASSERT_TRUE(generate(geometry));
  // Of the last one: u = -x and v = -y - x, so that along its u at constant v x and y are opposed.
  const float quarter = 3.14159265F / 4;
  const float x = 2 * quarter + 2 * quarter * std::sqrt(0.5F);
  const float y = -2 * quarter * std::sqrt(0.5F);
  const float length = std::sqrt(x * x + y * y);
  EXPECT_THAT(geometry.tangents[0], near_tangent(x / length, y / length, 0, 1));
  EXPECT_THAT(geometry.tangents[1], near_tangent(1, 0, 0, 1));
}

TEST(TangentSpace, VerticesAreSplitWhereHandednessChanges) {
  Geometry geometry = book();
  geometry.colors.assign(6, {0, 0, 0, 1});
  geometry.colors[1] = {1, 0, 0, 1};
  // The right half shows the left one mirrored.
  geometry.tex_coords[0][2] = {0, 1};
  geometry.tex_coords[0][5] = {0, 0};
  ASSERT_TRUE(generate(geometry));
  ASSERT_THAT(geometry.positions, SizeIs(8));
  EXPECT_THAT(geometry.tangents, SizeIs(8));
  EXPECT_THAT(geometry.normals, SizeIs(8));
  EXPECT_THAT(geometry.tex_coords[0], SizeIs(8));
  EXPECT_THAT(geometry.colors[geometry.triangles[2][0]], ElementsAre(1, 0, 0, 1));
  for (std::size_t t = 0; t < 4; ++t) {
    for (const std::uint32_t i : geometry.triangles[t]) {
      EXPECT_THAT(geometry.tangents[i],
                  t < 2 ? near_tangent(1, 0, 0, 1) : near_tangent(-1, 0, 0, -1))
          << t;
    }
  }
}

TEST(TangentSpace, CoordinatesWithoutAreaTakeWhatIsBesideThem) {
  Geometry geometry = square_geometry();
  geometry.positions.push_back({0, 2, 0});
  geometry.normals.push_back({0, 0, 1});
  geometry.tex_coords[0].push_back({0, 0});
  geometry.triangles.push_back({3, 2, 4});
  ASSERT_TRUE(generate(geometry));
  EXPECT_THAT(geometry.positions, SizeIs(5)) << "nothing is split for it";
  EXPECT_THAT(geometry.tangents[2], near_tangent(1, 0, 0, 1));
  EXPECT_EQ(geometry.tangents[4][2], 0) << "any direction across the normal";
}

TEST(TangentSpace, NothingToGoByGivesTangentsAllTheSame) {
  Geometry geometry = square_geometry();
  for (auto& uv : geometry.tex_coords[0]) uv = {0.5F, 0.5F};
  geometry.positions[1] = geometry.positions[0];
  geometry.tex_coords[0][2] = {std::nanf(""), 0};
  ASSERT_TRUE(generate(geometry));
  for (const auto& [x, y, z, w] : geometry.tangents) {
    EXPECT_NEAR(x * x + y * y + z * z, 1, 1e-5);
    EXPECT_EQ(std::abs(w), 1);
  }
}

TEST(TangentSpace, MemoryIsAskedForFirst) {
  Geometry geometry = square_geometry();
  EXPECT_FALSE(generate(geometry, 4 * 16 - 1));
  EXPECT_THAT(geometry.tangents, IsEmpty());
  EXPECT_TRUE(generate(geometry, 4 * 16));
}

TEST(TangentSpace, EdgesOfManyTrianglesPairUp) {
  // Fins around one edge: a surface that is none.
  Geometry geometry;
  geometry.positions = {{0, 0, 0}, {0, 0, 1}};
  geometry.tex_coords = {{{0, 0}, {0, 1}}};
  for (std::uint32_t i = 0; i < 5000; ++i) {
    const float angle = static_cast<float>(i);
    geometry.positions.push_back({std::cos(angle), std::sin(angle), 0});
    geometry.tex_coords[0].push_back({1, 0});
    geometry.triangles.push_back({i % 2, 1 - i % 2, i + 2});
  }
  geometry.normals.assign(geometry.positions.size(), {0, 0, 1});
  EXPECT_TRUE(generate(geometry));
}

}  // namespace
}  // namespace gltfx::model
