// SPDX-License-Identifier: Apache-2.0
// Triangles and vertices are ordered for GPU caches.
#include <array>
#include <set>

#include <gmock/gmock.h>

#include "made_asset.hpp"

namespace gltfx {
namespace {

using test::MadeAsset;
using test::numbers_of;
using test::OrderedJson;
using test::StoredAsset;
using testing::ElementsAre;
using testing::Gt;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::uint32_t kSide = 33;  // vertices per side of a grid

ConvertOptions reorder_options() {
  ConvertOptions options;
  options.reorder = true;
  return options;
}

// Two triangles for each cell of a grid, with cells in a scattered order.
std::vector<std::uint16_t> jumping_triangles() {
  constexpr std::uint32_t kCells = (kSide - 1) * (kSide - 1);
  std::vector<std::uint16_t> indices;
  for (std::uint32_t i = 0; i < kCells; ++i) {
    const std::uint32_t cell = i * 389 % kCells;
    const std::uint32_t at = cell / (kSide - 1) * kSide + cell % (kSide - 1);
    for (const std::uint32_t corner : {at, at + 1, at + kSide, at + 1, at + kSide + 1, at + kSide})
      indices.push_back(static_cast<std::uint16_t>(corner));
  }
  return indices;
}

// A grid with the number of each vertex in an attribute and in a morph target.
struct ShuffledGrid {
  ShuffledGrid() {
    std::vector<float> positions, targets;
    std::vector<std::uint8_t> numbers;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      positions.insert(positions.end(),
                       {static_cast<float>(i % kSide), static_cast<float>(i / kSide), 0});
      targets.insert(targets.end(), {0, 0, static_cast<float>(i)});
      numbers.insert(numbers.end(), {static_cast<std::uint8_t>(i % 256),
                                     static_cast<std::uint8_t>(i / 256), 0, 255});
    }
    position = made.accessor(positions, "VEC3", true);
    number = made.accessor(numbers, "VEC4");
    made.json["accessors"][number]["normalized"] = true;
    target = made.accessor(targets, "VEC3", true);
    indices = made.accessor(jumping_triangles(), "SCALAR", true);
    made.mesh(primitive_of(indices));
  }
  OrderedJson primitive_of(std::size_t list) const {
    return {{"attributes", {{"POSITION", position}, {"COLOR_0", number}}},
            {"targets", {{{"POSITION", target}}}},
            {"indices", list}};
  }
  OrderedJson& primitive() { return made.json["meshes"][0]["primitives"][0]; }
  void use(const std::string& extension) { made.json["extensionsUsed"].push_back(extension); }
  void material(const OrderedJson& material) {
    made.json["materials"].push_back(material);
    primitive()["material"] = made.json["materials"].size() - 1;
  }

  MadeAsset made;
  std::size_t position, number, target, indices;
};

class Reorder : public test::ConvertMade {
 protected:
  Reorder() : ConvertMade(reorder_options()) {}

  // The triangles as old vertex numbers; each starts at its least corner.
  static std::multiset<std::array<double, 3>> triangles(const StoredAsset& asset,
                                                        const ShuffledGrid& grid) {
    const auto targets = numbers_of(asset, grid.target);
    const auto indices = numbers_of(asset, grid.indices);
    std::multiset<std::array<double, 3>> all;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
      std::array<double, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = targets.at(static_cast<std::size_t>(indices[i + k]) * 3 + 2);
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      all.insert(corners);
    }
    return all;
  }

  // The number of vertices that a FIFO cache of 16 entries shades.
  static std::size_t misses(const std::vector<double>& indices) {
    std::vector<double> cache;
    std::size_t count = 0;
    for (const double index : indices) {
      if (std::find(cache.begin(), cache.end(), index) != cache.end()) continue;
      cache.push_back(index);
      if (cache.size() > 16) cache.erase(cache.begin());
      ++count;
    }
    return count;
  }
};

TEST_F(Reorder, OrdersTrianglesForACacheAndVerticesByUse) {
  ShuffledGrid grid;
  const StoredAsset old(grid.made.glb());
  const StoredAsset now = converted_twice(grid.made.glb());
  EXPECT_EQ(triangles(now, grid), triangles(old, grid));
  const auto indices = numbers_of(now, grid.indices);
  EXPECT_LT(2 * misses(indices), misses(numbers_of(old, grid.indices)));
  double next = 0;
  for (const double index : indices) {
    ASSERT_LE(index, next) << "vertices are in the order of their first use";
    next = std::max(next, index + 1);
  }
  EXPECT_EQ(row_.what, "1 primitive");
  EXPECT_THAT(row_.losses, IsEmpty());
  EXPECT_THAT(row_.left, IsEmpty());
}

TEST_F(Reorder, OrdersAttributesAndTargets) {
  ShuffledGrid grid;
  const StoredAsset now = converted_twice(grid.made.glb());
  const auto positions = numbers_of(now, grid.position);
  const auto colors = numbers_of(now, grid.number);
  const auto targets = numbers_of(now, grid.target);
  for (std::size_t i = 0; i < kSide * kSide; ++i) {
    ASSERT_EQ(colors[i * 4] + 256 * colors[i * 4 + 1], targets[i * 3 + 2]);
    ASSERT_EQ(positions[i * 3] + kSide * positions[i * 3 + 1], targets[i * 3 + 2]);
  }
  EXPECT_EQ(now.json()["accessors"][grid.position]["max"].dump(), "[32.0,32.0,0.0]");
}

TEST_F(Reorder, MovesUnusedVerticesToTheEnd) {
  MadeAsset made;
  const std::size_t at =
      made.accessor<float>({9, 9, 9, 0, 0, 0, 1, 0, 0, 8, 8, 8, 0, 1, 0}, "VEC3", true);
  const std::size_t indices = made.accessor<std::uint8_t>({4, 1, 2}, "SCALAR", true);
  made.mesh({{"attributes", {{"POSITION", at}}}, {"indices", indices}});
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_THAT(numbers_of(now, indices), ElementsAre(0, 1, 2));
  EXPECT_THAT(numbers_of(now, at), ElementsAre(0, 1, 0, 0, 0, 0, 1, 0, 0, 9, 9, 9, 8, 8, 8));
  EXPECT_EQ(now.json()["accessors"][indices]["min"].dump(), "[0]");
  EXPECT_EQ(now.json()["accessors"][indices]["max"].dump(), "[2]");
}

TEST_F(Reorder, OrdersPrimitivesThatShareVerticesTogether) {
  ShuffledGrid grid;
  auto backwards = jumping_triangles();
  std::reverse(backwards.begin(), backwards.end());
  const std::size_t other = grid.made.accessor(backwards, "SCALAR");
  grid.made.mesh(grid.primitive_of(other));
  grid.made.mesh(grid.primitive_of(grid.indices));
  const StoredAsset old(grid.made.glb());
  const StoredAsset now = converted_twice(grid.made.glb());
  EXPECT_EQ(row_.what, "3 primitives");
  EXPECT_EQ(triangles(now, grid), triangles(old, grid));
  EXPECT_LT(2 * misses(numbers_of(now, other)), misses(numbers_of(old, other)));
}

TEST_F(Reorder, LeavesBlendedTriangles) {
  const std::string why = "is blended, so the order of its triangles is visible";
  ShuffledGrid blended;
  blended.material({{"alphaMode", "BLEND"}});
  expect_left(blended.made, why);
  ShuffledGrid glass;
  glass.use("KHR_materials_transmission");
  glass.material({{"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 0.5}}}}}});
  expect_left(glass.made, why);
  ShuffledGrid variant;
  variant.use("KHR_materials_variants");
  variant.material({{"alphaMode", "BLEND"}});
  variant.material({{"alphaMode", "MASK"}});
  variant.made.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "a"}}};
  variant.primitive()["extensions"]["KHR_materials_variants"]["mappings"] = {
      {{"material", 0}, {"variants", {0}}}};
  expect_left(variant.made, why);
  variant.made.json["materials"][0]["alphaMode"] = "OPAQUE";
  converted_twice(variant.made.glb());
}

TEST_F(Reorder, LeavesOtherModes) {
  ShuffledGrid points;
  points.primitive()["mode"] = 0;
  expect_left(points.made, "has primitives that are not triangles");
  ShuffledGrid strip;
  strip.primitive()["mode"] = 5;
  expect_left(strip.made, "has primitives that are not triangles");
  ShuffledGrid plain;
  plain.primitive().erase("indices");
  const ConvertStep row = row_of(plain.made.glb());
  EXPECT_FALSE(row.changes);
  ASSERT_THAT(row.left, SizeIs(1));
  EXPECT_EQ(row.left[0].reason, "has triangles without indices");
}

TEST_F(Reorder, LeavesBrokenPrimitives) {
  ShuffledGrid outside;
  outside.primitive()["indices"] =
      outside.made.accessor<std::uint16_t>({0, 1, kSide * kSide}, "SCALAR");
  expect_left(outside.made, "has an index that is out of range");
  static_assert(kSide * kSide > 255);
  ShuffledGrid reserved;
  reserved.primitive()["indices"] = reserved.made.accessor<std::uint8_t>({0, 1, 255}, "SCALAR");
  expect_left(reserved.made, "has an index that is reserved for primitive restart");
  ShuffledGrid torn;
  torn.primitive()["indices"] = torn.made.accessor<std::uint16_t>({0, 1, 2, 3}, "SCALAR");
  expect_left(torn.made, "has an incomplete triangle");
}

TEST_F(Reorder, RefusesIfAnExtensionRefersToVertices) {
  ShuffledGrid unknown;
  unknown.use("ACME_outline");
  unknown.primitive()["extensions"]["ACME_outline"]["name"] = "front";
  expect_refused(unknown.made, "/meshes/0/primitives/0",
                 "ACME_outline may hold indices of its vertices (describe it with --schema)");
  ShuffledGrid features;
  features.use("EXT_mesh_features");
  features.primitive()["extensions"]["EXT_mesh_features"]["featureIds"] = {{{"featureCount", 4}}};
  expect_refused(features.made, "/meshes/0/primitives/0",
                 "EXT_mesh_features uses vertex numbers as ids");
  ShuffledGrid reference;
  reference.use("ACME_ref");
  reference.made.json["nodes"][0]["extensions"]["ACME_ref"]["curve"] = 0;
  expect_refused(reference.made, "",
                 "/nodes/0/extensions/ACME_ref may hold indices of accessors "
                 "(describe it with --schema)");
}

// Weld merges all corners of the last triangle, which becomes degenerate.
TEST_F(Reorder, AcceptsDegenerateTrianglesAfterWeld) {
  options_.weld = true;
  MadeAsset made;
  std::vector<float> positions;
  for (const std::uint16_t corner : jumping_triangles()) {
    for (const int i : {0, 1, 2}) {
      const auto x = static_cast<float>(i == 0 ? corner % kSide : corner / kSide);
      positions.push_back(i == 2 ? 0 : x);
    }
  }
  for (int i = 0; i < 3; ++i) positions.insert(positions.end(), {1, 1, 1});
  made.mesh({{"attributes", {{"POSITION", made.accessor(positions, "VEC3", true)}}}});
  const ConvertReport report = run(made.glb());
  EXPECT_TRUE(report.written) << report.error;
  ASSERT_THAT(report.steps, SizeIs(Gt(2U)));
  EXPECT_TRUE(report.steps[0].changes && report.steps[1].changes);
  const StoredAsset now = StoredAsset::at(output());
  EXPECT_EQ(now.json()["accessors"][0]["count"], kSide * kSide + 1);
  EXPECT_LT(misses(numbers_of(now, 1)), jumping_triangles().size() / 3);
}

}  // namespace
}  // namespace gltfx
