// SPDX-License-Identifier: Apache-2.0
// Overlaps, islands and gutters: against simpler ways to find them, under changes that do not
// matter, and for coordinates that nobody makes.
#include "measure/uv_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "measure/uv_islands.hpp"

namespace gltfx::measure {
namespace {

using Triangles = std::vector<UvTriangle>;

UvSurface surface_of(const Triangles& triangles) {
  UvSurface surface;
  for (const UvTriangle& triangle : triangles) {
    const auto first = static_cast<std::uint32_t>(surface.points.size());
    surface.points.insert(surface.points.end(), triangle.begin(), triangle.end());
    if (is_finite(triangle) && !is_degenerate(triangle)) {
      surface.triangles.push_back({first, first + 1, first + 2});
    }
  }
  return surface;
}

std::size_t overlaps(const Triangles& triangles) {
  UvOverlap overlap(surface_of(triangles));
  EXPECT_TRUE(overlap.find());
  return overlap.count();
}

// The area that two triangles share: one is clipped at the edges of the other.
double common_area(const UvTriangle& one, UvTriangle other) {
  using Point = std::array<double, 2>;
  if (signed_area(other) < 0) std::swap(other[0], other[1]);
  std::vector<Point> polygon;
  for (const UvPoint& corner : one) polygon.push_back({corner[0], corner[1]});
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const UvPoint a = other[edge];
    const UvPoint b = other[(edge + 1) % 3];
    const auto side = [&](const Point& at) {
      return (b[0] - a[0]) * (at[1] - a[1]) - (b[1] - a[1]) * (at[0] - a[0]);
    };
    std::vector<Point> inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point& from = polygon[i];
      const Point& to = polygon[(i + 1) % polygon.size()];
      if (side(from) >= 0) inside.push_back(from);
      if ((side(from) < 0) == (side(to) < 0)) continue;
      const double t = side(from) / (side(from) - side(to));
      inside.push_back({from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])});
    }
    polygon = inside;
  }
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& from = polygon[i];
    const Point& to = polygon[(i + 1) % polygon.size()];
    twice += from[0] * to[1] - from[1] * to[0];
  }
  return std::abs(twice) / 2;
}

Triangles random_triangles(std::uint32_t seed, std::size_t count, float size) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(0, 1), offset(-size, size);
  Triangles triangles(count);
  for (UvTriangle& triangle : triangles) {
    const UvPoint at{place(random), place(random)};
    for (UvPoint& corner : triangle) corner = {at[0] + offset(random), at[1] + offset(random)};
  }
  return triangles;
}

TEST(UvOverlap, FindsWhatClippingEachPairFinds) {
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    const Triangles triangles = random_triangles(seed, 60, seed % 2 == 0 ? 0.02F : 0.1F);
    std::size_t expected = 0;
    for (const UvTriangle& one : triangles) {
      const bool shares = std::any_of(triangles.begin(), triangles.end(), [&](const auto& other) {
        return &other != &one && common_area(one, other) > 1e-9;
      });
      if (shares) ++expected;
    }
    EXPECT_EQ(overlaps(triangles), expected) << seed;
  }
}

// Squares of two triangles with a space between them.
Triangles grid_of(std::size_t side, float space) {
  Triangles triangles;
  const float step = 1.0F / static_cast<float>(side);
  for (std::size_t i = 0; i < side * side; ++i) {
    const float u = static_cast<float>(i % side) * step;
    const float v = static_cast<float>(i / side) * step;
    const float end_u = u + step - space;
    const float end_v = v + step - space;
    triangles.push_back({{{u, end_v}, {end_u, end_v}, {end_u, v}}});
    triangles.push_back({{{u, end_v}, {end_u, v}, {u, v}}});
  }
  return triangles;
}

TEST(UvOverlap, DoesNotDependOnOrderTurnsAndTiles) {
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    Triangles triangles = random_triangles(seed, 300, 0.03F);
    for (UvTriangle& triangle : triangles) {  // so that sums and differences are exact
      for (UvPoint& corner : triangle) {
        for (float& value : corner) value = std::round(value * 4096) / 4096;
      }
    }
    const std::size_t count = overlaps(triangles);
    const std::size_t islands = find_islands(surface_of(triangles)).count;
    const auto after = [&](const auto& change) {
      Triangles changed = triangles;
      for (UvTriangle& triangle : changed) {
        for (UvPoint& corner : triangle) corner = change(corner);
      }
      EXPECT_EQ(find_islands(surface_of(changed)).count, islands);
      return overlaps(changed);
    };
    EXPECT_EQ(after([](UvPoint p) { return UvPoint{-p[1], p[0]}; }), count) << "turned";
    EXPECT_EQ(after([](UvPoint p) { return UvPoint{-p[0], p[1]}; }), count) << "mirrored";
    EXPECT_EQ(after([](UvPoint p) { return UvPoint{p[0] + 7, p[1] - 3}; }), count) << "moved";
    std::shuffle(triangles.begin(), triangles.end(), std::mt19937(seed));
    for (UvTriangle& triangle : triangles)
      std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
    EXPECT_EQ(after([](UvPoint p) { return p; }), count) << "reordered";
  }
}

TEST(UvOverlap, CopiesInTheSamePlaceOverlap) {
  const Triangles grid = grid_of(30, 0.001F);
  EXPECT_EQ(overlaps(grid), 0U);
  Triangles layers;
  for (int layer = 0; layer < 5; ++layer) layers.insert(layers.end(), grid.begin(), grid.end());
  EXPECT_EQ(overlaps(layers), layers.size());
  Triangles one_more = grid;
  one_more.push_back({{{0, 0}, {2, 0}, {0, 2}}});
  EXPECT_EQ(overlaps(one_more), one_more.size());
}

TEST(UvOverlap, AFarTriangleDoesNotMatter) {
  Triangles grid = grid_of(40, 0.001F);
  grid.push_back({{{1e30F, 0}, {1.1e30F, 0}, {1e30F, 1e30F}}});
  grid.push_back({{{-3e38F, 3e38F}, {-3e38F, 0}, {-2e38F, 0}}});
  EXPECT_EQ(overlaps(grid), 0U);
}

// Parallel slivers: the rectangles around all of them overlap, and no two of them share area.
TEST(UvOverlap, GivesUpWhereEachPairWouldHaveToBeTested) {
  Triangles slivers;
  for (int i = 0; i < 4'000; ++i) {
    const float at = static_cast<float>(i) / 4096;
    slivers.push_back({{{at, 0}, {at + 1.0F / 8192, 0}, {at + 10, 10}}});
  }
  UvOverlap overlap(surface_of(slivers));
  EXPECT_FALSE(overlap.find());
}

TEST(UvOverlap, AllInOneCellAreFoundAtOnce) {
  const Triangles same(10'000, UvTriangle{{{0.5F, 0.5F}, {0.6F, 0.5F}, {0.5F, 0.6F}}});
  UvOverlap overlap(surface_of(same));
  EXPECT_TRUE(overlap.find());
  EXPECT_EQ(overlap.count(), same.size());
  const auto cover = overlap.cover();
  ASSERT_TRUE(cover);
  EXPECT_EQ(cover->twice, cover->once);
  EXPECT_NEAR(cover->in_square, 0.005, 1e-4);
}

TEST(UvCover, FarIslandsCountAsNearOnes) {
  Triangles triangles;
  for (const float at : {0.0F, 1.0F, 1000.0F}) {
    const Triangles grid = grid_of(10, 0.02F);
    for (const int layer : {0, 1}) {
      for (UvTriangle triangle : grid) {
        for (UvPoint& corner : triangle) corner = {corner[0] + at, corner[1] - at};
        if (layer == 0 || at > 0) triangles.push_back(triangle);
      }
    }
  }
  UvOverlap overlap(surface_of(triangles));
  ASSERT_TRUE(overlap.find());
  const auto cover = overlap.cover();
  ASSERT_TRUE(cover);
  EXPECT_NEAR(cover->once, 3 * 0.64, 0.03);
  EXPECT_NEAR(cover->twice, 2 * 0.64, 0.03);
  EXPECT_NEAR(cover->in_square, 0.64, 1e-4);
}

TEST(UvCover, LayersBeyondTheSecondDoNotMatter) {
  std::vector<UvTriangle> layers;
  for (int i = 0; i < 1000; ++i) layers.push_back({{{0, 0}, {0.5F, 0}, {0, 0.5F}}});
  layers.push_back({{{2, 2}, {1, 2}, {2, 1}}});
  const auto cover = estimate_cover(layers);
  ASSERT_TRUE(cover);
  EXPECT_NEAR(cover->once, 0.625, 0.002);
  EXPECT_NEAR(cover->twice, 0.125, 0.001);
}

TEST(UvIslands, GutterIsTheLeastDistanceOfAnyTwo) {
  const TexelGrid texels{256, 128, false, false};
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    const Triangles triangles = random_triangles(seed, 5 + seed % 6, 0.05F);
    const UvIslands islands = find_islands(surface_of(triangles));
    ASSERT_EQ(islands.count, triangles.size());
    // Points on the outlines, close to each other.
    double least = kMostGutter;
    constexpr int kSteps = 40;
    const auto point = [&](const UvOutline& edge, int step) {
      const float t = static_cast<float>(step) / kSteps;
      return UvPoint{(edge.from[0] + t * (edge.to[0] - edge.from[0])) * 256,
                     (edge.from[1] + t * (edge.to[1] - edge.from[1])) * 128};
    };
    for (const UvOutline& one : islands.outlines) {
      for (const UvOutline& other : islands.outlines) {
        if (one.island <= other.island) continue;
        for (int i = 0; i <= kSteps; ++i) {
          const UvPoint at = point(one, i);
          for (int j = 0; j <= kSteps; ++j) {
            const UvPoint to = point(other, j);
            least = std::min(least, double{std::hypot(to[0] - at[0], to[1] - at[1])});
          }
        }
      }
    }
    const auto gutter = find_gutter(islands.outlines, texels);
    ASSERT_TRUE(gutter);
    EXPECT_LE(*gutter, least + 1e-4) << seed;
    EXPECT_GE(*gutter, least - 0.5) << seed << ": the steps along an edge";
  }
}

TEST(UvIslands, AGridOfIslandsHasItsSpaceAsGutter) {
  const auto gutter = find_gutter(find_islands(surface_of(grid_of(64, 1.0F / 512))).outlines,
                                  {1024, 1024, true, true});
  ASSERT_TRUE(gutter);
  EXPECT_EQ(*gutter, 2);
}

}  // namespace
}  // namespace gltfx::measure
