// SPDX-License-Identifier: Apache-2.0
#include "measure/weld.hpp"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "measure/surface_asset.hpp"

namespace gltfx::measure {
namespace {

using model::Triangle;
using testing::ElementsAre;

// A triangle for each position, so that all are used.
std::vector<Triangle> triangles_over(std::size_t count) {
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < count; ++i) triangles.push_back({i, i, i});
  return triangles;
}

TEST(Weld, EqualPositionsBecomeOneInTheOrderOfUse) {
  std::vector<Float3> positions{{9, 9, 9}, {1, 0, 0}, {0, 1, 0}, {-0.0F, 1, 0}, {1, 0, -0.0F}};
  std::vector<Triangle> triangles{{2, 1, 3}, {4, 3, 1}};
  ASSERT_TRUE(weld(positions, triangles, 0));
  EXPECT_THAT(positions, ElementsAre(Float3{0, 1, 0}, Float3{1, 0, 0}));
  EXPECT_THAT(triangles, ElementsAre(Triangle{0, 1, 0}, Triangle{1, 0, 1}));
}

TEST(Weld, NearPositionsAreGroupedAsByComparingAll) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> from(-1, 1);
  for (const double distance : {0.01, 0.05, 0.2}) {
    std::vector<Float3> positions;
    for (int i = 0; i < 300; ++i) positions.push_back({from(random), from(random), from(random)});
    std::vector<std::uint32_t> group(positions.size());
    for (std::uint32_t i = 0; i < group.size(); ++i) {
      group[i] = i;
      for (std::uint32_t j = 0; j < i; ++j) {
        const Vec3d between = to_vec(positions[i]) - to_vec(positions[j]);
        const auto mine = group[i], other = group[j];
        if (length(between) > distance || mine == other) continue;
        for (std::uint32_t& each : group) each = each == mine ? other : each;
      }
    }
    std::vector<Float3> welded = positions;
    auto triangles = triangles_over(positions.size());
    ASSERT_TRUE(weld(welded, triangles, distance));
    std::size_t groups = 0;
    for (std::uint32_t i = 0; i < group.size(); ++i) {
      groups += group[i] == i ? 1 : 0;
      EXPECT_EQ(triangles[i][0], triangles[group[i]][0]) << distance << ' ' << i;
    }
    EXPECT_EQ(welded.size(), groups) << distance;
  }
}

TEST(Weld, TheDistanceItselfIsNear) {
  for (const float apart : {0.5F, 0.50001F}) {
    std::vector<Float3> positions{{0, 0, 0}, {apart, 0, 0}};
    auto triangles = triangles_over(2);
    ASSERT_TRUE(weld(positions, triangles, 0.5));
    EXPECT_EQ(positions.size(), apart > 0.5F ? 2U : 1U);
  }
}

TEST(Weld, ClosesWhatExportersLeaveOpen) {
  test::Body body = test::cube();
  const test::Body stored = body;
  for (std::size_t i = 0; i < body.corners.size(); ++i) {  // each corner its own vertex, a bit off
    auto place = stored.places[stored.corners[i]];
    place[i % 3] += 1e-7F * static_cast<float>(i % 5);
    body.places.push_back(place);
    body.corners[i] = static_cast<std::uint32_t>(body.places.size() - 1);
  }
  Request request;
  EXPECT_EQ(
      test::value(test::measured(test::asset_of({body}), request), MeasureScope::mesh, "closed"),
      false);
  request.parameters.weld = 1e-6;
  const Measurements taken = test::measured(test::asset_of({body}), request);
  EXPECT_EQ(test::value(taken, MeasureScope::mesh, "closed"), true);
  EXPECT_EQ(test::value(taken, MeasureScope::mesh, "hard-edges"), 12);
}

// All pairs of a crowd are near: comparing them would take forever.
TEST(Weld, CrowdsEndTheSearch) {
  std::vector<Float3> positions;
  for (int i = 0; i < 20'000; ++i) positions.push_back({static_cast<float>(i) * 1e-9F, 0, 0});
  auto triangles = triangles_over(positions.size());
  EXPECT_FALSE(weld(positions, triangles, 1));
}

}  // namespace
}  // namespace gltfx::measure
