// SPDX-License-Identifier: Apache-2.0
// Distances of surfaces, against a search through all triangles.
#include "model/surface_distance.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>

#include "model/simplify.hpp"

namespace gltfx::model {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// Triangles with their own points.
struct Soup {
  std::vector<std::array<float, 3>> points;
  std::vector<std::uint32_t> corners;

  void add(std::array<float, 3> a, std::array<float, 3> b, std::array<float, 3> c) {
    for (const auto& each : {a, b, c}) {
      corners.push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back(each);
    }
  }
  Surface surface() const { return {points, corners}; }
};

Soup random_soup(unsigned seed, std::size_t triangles) {
  std::mt19937 random(seed);
  const auto number = [&](float most) {
    return most * (static_cast<float>(random() % 2048) / 1024 - 1);
  };
  Soup soup;
  for (std::size_t i = 0; i < triangles; ++i) {
    const std::array<float, 3> at{number(10), number(10), number(10)};
    const auto near = [&] {
      return std::array{at[0] + number(1), at[1] + number(1), at[2] + number(1)};
    };
    const auto a = near();
    soup.add(a, i % 16 == 0 ? a : near(), i % 32 == 0 ? a : near());  // some have no area
  }
  return soup;
}

// The least distance to points of a triangle, by dividing it.
double distance_by_division(const Vector3& to, std::array<Vector3, 3> triangle) {
  const auto away = [&](const Vector3& p) {
    return std::hypot(p[0] - to[0], p[1] - to[1], p[2] - to[2]);
  };
  const auto middle = [](const Vector3& a, const Vector3& b) {
    return Vector3{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
  };
  double best = std::numeric_limits<double>::infinity();
  for (int depth = 0; depth < 40; ++depth) {
    const auto [a, b, c] = triangle;
    const Vector3 ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    const std::array<std::array<Vector3, 3>, 4> parts{
        {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}}};
    double least = std::numeric_limits<double>::infinity();
    for (const auto& part : parts) {
      const Vector3 center{(part[0][0] + part[1][0] + part[2][0]) / 3,
                           (part[0][1] + part[1][1] + part[2][1]) / 3,
                           (part[0][2] + part[1][2] + part[2][2]) / 3};
      if (away(center) < least) {
        least = away(center);
        triangle = part;
      }
      for (const Vector3& corner : part) best = std::min(best, away(corner));
    }
    best = std::min(best, least);
  }
  return best;
}

TEST(SurfaceTree, FindsTheNearestTriangle) {
  const Soup soup = random_soup(1, 500);
  const SurfaceTree tree(soup.surface());
  std::mt19937 random(2);
  for (int i = 0; i < 50; ++i) {
    Vector3 point{};
    for (double& each : point) each = static_cast<double>(random() % 4096) / 128 - 16;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < soup.surface().triangles(); ++k) {
      best = std::min(best, distance_by_division(point, {soup.surface().corner(3 * k),
                                                         soup.surface().corner(3 * k + 1),
                                                         soup.surface().corner(3 * k + 2)}));
    }
    EXPECT_LE(tree.nearest(point, 0, 0).distance, best + 1e-9);
    EXPECT_GE(tree.nearest(point, 0, 0).distance, 0.99 * best) << "division is not exact";
    EXPECT_EQ(tree.nearest(point, 0, 7).distance, tree.nearest(point, 0, 0).distance);
    EXPECT_LE(tree.nearest(point, best + 1, 0).distance, best + 1);
  }
}

TEST(SurfaceTree, VisitsAllTrianglesThatAreNear) {
  const Soup soup = random_soup(3, 300);
  const SurfaceTree tree(soup.surface());
  std::vector<bool> visited(300);
  tree.each_near({0, 0, 0}, 5, [&](std::uint32_t triangle) {
    visited[triangle] = true;
    return true;
  });
  for (std::size_t k = 0; k < visited.size(); ++k) {
    if (visited[k]) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3 corner = soup.surface().corner(3 * k + i);
      EXPECT_GT(std::hypot(corner[0], corner[1], corner[2]), 5);
    }
  }
}

TEST(SurfaceDistance, IsTheGreaterOfBothDirections) {
  Soup small, large;
  small.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  large = small;
  large.add({0, 0, 3}, {1, 0, 3}, {0, 1, 3});
  const SurfaceTree one(small.surface()), other(large.surface());
  EXPECT_NEAR(surface_distance(one, one, 100, 1).distance, 0, 1e-12);
  EXPECT_EQ(surface_distance(one, other, 100, 1).distance, 3);
  EXPECT_EQ(surface_distance(other, one, 100, 1).distance, 3);
  EXPECT_EQ(surface_distance(other, one, 100, 1).at[2], 3);
  EXPECT_GT(surface_distance(one, other, 1, 1).distance, 1);
}

TEST(SurfaceDistance, DoesNotDependOnThreads) {
  const Soup a = random_soup(4, 20000), b = random_soup(5, 20000);
  const SurfaceTree one(a.surface()), other(b.surface());
  EXPECT_EQ(surface_distance(one, other, 1e9, 1).distance,
            surface_distance(one, other, 1e9, 4).distance);
}

TEST(SurfaceDistance, IsInfiniteToNothing) {
  Soup some;
  some.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Soup none;
  const SurfaceTree one(some.surface()), other(none.surface());
  EXPECT_TRUE(std::isinf(surface_distance(one, other, 1, 1).distance));
  EXPECT_EQ(surface_distance(other, other, 1, 1).distance, 0);
}

TEST(OpenEdges, HaveNoTriangleInTheOtherDirection) {
  const std::vector<std::uint32_t> same{0, 1, 2, 3, 2};
  EXPECT_THAT(open_edges(std::vector<std::uint32_t>{0, 1, 2, 0, 4, 3}, same), SizeIs(4))
      << "4 is at the place of 2";
  EXPECT_THAT(open_edges(std::vector<std::uint32_t>{0, 1, 2, 2, 1, 0}, same), IsEmpty());
  EXPECT_THAT(open_edges(std::vector<std::uint32_t>{2, 4, 0}, same), IsEmpty()) << "no area";
}

TEST(Simplify, IsNotAffordableForFansOfManyTriangles) {
  const auto fan = [](std::uint32_t count) {
    Soup soup;
    soup.points.resize(count + 1);
    for (std::uint32_t i = 1; i < count; ++i) {
      for (const std::uint32_t corner : {0U, i, i + 1}) soup.corners.push_back(corner);
    }
    return soup;
  };
  for (const std::uint32_t count : {100U, 100000U}) {
    const Soup soup = fan(count);
    std::vector<std::uint32_t> same(soup.points.size());
    for (std::uint32_t i = 0; i < same.size(); ++i) same[i] = i;
    EXPECT_EQ(is_affordable(soup.surface(), same), count == 100);
  }
}

}  // namespace
}  // namespace gltfx::model
