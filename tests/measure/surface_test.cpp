// SPDX-License-Identifier: Apache-2.0
// Random triangles over few positions, so that all flaws occur, against plain definitions.
#include "measure/surface.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "measure/weld.hpp"

namespace gltfx::measure {
namespace {

Surface random_surface(std::mt19937& random) {
  const auto below = [&](unsigned limit) {
    return std::uniform_int_distribution<std::uint32_t>(0, limit - 1)(random);
  };
  std::vector<Float3> positions(1 + below(12));
  for (Float3& position : positions) {
    for (float& each : position) each = static_cast<float>(below(4));
  }
  std::vector<model::Triangle> triangles(below(20));
  for (model::Triangle& triangle : triangles) {
    for (std::uint32_t& vertex : triangle) {
      vertex = below(static_cast<unsigned>(positions.size()));
    }
  }
  EXPECT_TRUE(weld(positions, triangles, 0));
  return make_surface(positions, triangles);
}

bool has(const model::Triangle& triangle, std::uint32_t vertex) {
  return std::find(triangle.begin(), triangle.end(), vertex) != triangle.end();
}

// The number of groups of triangles that are joined by vertices other than `except`.
std::size_t groups_of(const std::vector<model::Triangle>& triangles, std::uint32_t except) {
  std::vector<std::size_t> group(triangles.size());
  for (std::size_t i = 0; i < group.size(); ++i) {
    group[i] = i;
    for (std::size_t j = 0; j < i; ++j) {
      const bool joined = std::any_of(
          triangles[i].begin(), triangles[i].end(),
          [&](std::uint32_t vertex) { return vertex != except && has(triangles[j], vertex); });
      const std::size_t mine = group[i], other = group[j];
      if (joined) std::replace(group.begin(), group.end(), mine, other);
    }
  }
  return std::set<std::size_t>(group.begin(), group.end()).size();
}

EdgeCounts edges_of(const Surface& surface) {
  std::map<std::array<std::uint32_t, 2>, std::vector<bool>> edges;  // whether it runs upwards
  for (const auto& [a, b, c] : surface.triangles) {
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
      edges[{std::min(from, to), std::max(from, to)}].push_back(from < to);
    }
  }
  EdgeCounts counts;
  for (const auto& [edge, runs] : edges) {
    counts.open += runs.size() == 1 ? 1 : 0;
    counts.non_manifold += runs.size() > 2 ? 1 : 0;
    counts.flipped += runs.size() == 2 && runs[0] == runs[1] ? 1 : 0;
  }
  for (std::uint32_t vertex = 0; vertex < surface.positions.size(); ++vertex) {
    std::vector<model::Triangle> around;
    for (const auto& triangle : surface.triangles) {
      if (has(triangle, vertex)) around.push_back(triangle);
    }
    counts.non_manifold_vertices += groups_of(around, vertex) > 1 ? 1 : 0;
  }
  return counts;
}

TEST(Surface, CountsAreThoseOfTheDefinitions) {
  std::mt19937 random(17);
  for (int round = 0; round < 2000; ++round) {
    const Surface surface = random_surface(random);
    const EdgeCounts found = count_edges(surface, 90, true), wanted = edges_of(surface);
    EXPECT_EQ(found.open, wanted.open) << round;
    EXPECT_EQ(found.non_manifold, wanted.non_manifold) << round;
    EXPECT_EQ(found.flipped, wanted.flipped) << round;
    EXPECT_EQ(found.non_manifold_vertices, wanted.non_manifold_vertices) << round;
    EXPECT_EQ(count_shells(surface), groups_of(surface.triangles, UINT32_MAX)) << round;
    std::set<model::Triangle> distinct;
    for (model::Triangle triangle : surface.triangles) {
      std::sort(triangle.begin(), triangle.end());
      distinct.insert(triangle);
    }
    EXPECT_EQ(count_duplicates(surface), surface.triangles.size() - distinct.size()) << round;
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace gltfx::measure
