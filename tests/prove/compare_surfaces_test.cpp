// SPDX-License-Identifier: Apache-2.0
/// Surfaces of other triangles, and vertices that joints move.
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "prove/compare.hpp"
#include "prove/edited_asset.hpp"

namespace gltfx::prove {
namespace {

using test::EditedAsset;
using test::Json;
using testing::HasSubstr;
using testing::SizeIs;

struct SheetVertex {
  std::array<float, 3> place;
  std::array<float, 2> texcoord;
};
using Height = std::function<float(float, float)>;

float flat(float, float) { return 0; }

/// A unit square of `count` by `count` squares with normals and texture coordinates. `last`: rows
/// of squares that are left out. `turned`: along the other diagonal.
EditedAsset sheet(unsigned count, const Height& height = flat, unsigned last = 0,
                  bool turned = false, float slide = 0) {
  std::vector<float> places, normals, texcoords;
  for (unsigned y = 0; y <= count; ++y) {
    for (unsigned x = 0; x <= count; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(count);
      const float v = static_cast<float>(y) / static_cast<float>(count);
      places.insert(places.end(), {u, v, height(u, v)});
      normals.insert(normals.end(), {0, 0, 1});
      texcoords.insert(texcoords.end(), {u + slide, v});
    }
  }
  std::vector<std::uint32_t> corners;
  for (unsigned y = 0; y + last < count; ++y) {
    for (unsigned x = 0; x < count; ++x) {
      const std::uint32_t a = y * (count + 1) + x, b = a + 1, c = a + count + 1, d = c + 1;
      if (turned) {
        corners.insert(corners.end(), {a, b, c, b, d, c});
      } else {
        corners.insert(corners.end(), {a, b, d, a, d, c});
      }
    }
  }
  std::string bytes;
  Json views, accessors;
  const auto add = [&](const auto& list, const char* type, unsigned width, int component) {
    const std::size_t size = list.size() * sizeof(list[0]);
    views.push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}});
    accessors.push_back({{"bufferView", accessors.size()},
                         {"componentType", component},
                         {"count", list.size() / width},
                         {"type", type}});
    bytes.append(reinterpret_cast<const char*>(list.data()), size);
  };
  add(places, "VEC3", 3, 5126);
  add(normals, "VEC3", 3, 5126);
  add(texcoords, "VEC2", 2, 5126);
  add(corners, "SCALAR", 1, 5125);
  EditedAsset asset = EditedAsset::made(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"name": "Sheet", "primitives": [
      {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3}]}]})",
                                        bytes);
  asset.json["bufferViews"] = views;
  asset.json["accessors"] = accessors;
  return asset;
}

CompareReport between(const EditedAsset& before, const EditedAsset& after,
                      const CompareOptions& options = {}) {
  CompareReport report;
  compare_assets(before.open(), after.open(), *schema::builtin_set(), options, report);
  return report;
}

std::string sentences(const CompareReport& report) {
  std::string text(compare_level_name(report.level));
  for (const Change& change : report.changes) {
    text += "\n  " + std::string(change.kind) + ": " + change.what;
  }
  return text;
}

TEST(CompareSurfaces, OfOtherTrianglesIsWithinBounds) {
  const EditedAsset one = sheet(1);
  for (const EditedAsset& other : {sheet(4), sheet(7, flat, 0, true), sheet(1, flat, 0, true)}) {
    for (const bool back : {false, true}) {
      const CompareReport report = back ? between(other, one) : between(one, other);
      EXPECT_EQ(report.level, CompareLevel::bounds) << sentences(report);
      ASSERT_THAT(report.changes, SizeIs(1)) << sentences(report);
      EXPECT_EQ(report.changes.front().kind, "geometry.elements");
      EXPECT_THAT(report.changes.front().what, HasSubstr("the same surface"));
    }
  }
}

TEST(CompareSurfaces, SeesTextureCoordinatesWithoutAMaterial) {
  const CompareReport report = between(sheet(1), sheet(1, flat, 0, false, 0.01F));
  EXPECT_EQ(report.level, CompareLevel::differs) << sentences(report);
  ASSERT_THAT(report.changes, SizeIs(1)) << sentences(report);
  EXPECT_EQ(report.changes.front().kind, "geometry.texcoord");
}

TEST(CompareSurfaces, SeesWhatBoundsDoNotAllow) {
  const EditedAsset one = sheet(1);
  const auto hill = [](float u, float v) { return u == 0.5F && v == 0.5F ? 0.01F : 0.0F; };
  CompareOptions wide;
  wide.bounds.position = 0.02;
  wide.bounds.texcoord = 2;  // the nearest points of a slope are beside those below it
  const std::vector<std::pair<EditedAsset, bool>> others{
      {sheet(4, hill), true},                    // a vertex in the middle is higher
      {sheet(4, flat, 1), false},                // a part is gone
      {sheet(4, flat, 0, false, 0.01F), false},  // texture coordinates slide
  };
  for (const auto& each : others) {
    const EditedAsset& other = each.first;
    for (const bool back : {false, true}) {
      const auto compare = [&](const CompareOptions& options) {
        return back ? between(other, one, options) : between(one, other, options);
      };
      const CompareReport report = compare({});
      EXPECT_EQ(report.level, CompareLevel::differs) << sentences(report);
      EXPECT_THAT(report.changes, SizeIs(1)) << sentences(report);
      EXPECT_EQ(compare(wide).level == CompareLevel::bounds, each.second)
          << sentences(compare(wide));
    }
  }
}

TEST(CompareSurfaces, PairsTrianglesOfAnotherOrderThatAreNearlyAtTheirPlaces) {
  EditedAsset before = sheet(4);
  for (const char* name : {"NORMAL", "TEXCOORD_0"}) {
    before.json["meshes"][0]["primitives"][0]["attributes"].erase(name);
  }
  EditedAsset after = before;
  const auto vertices = after.json["accessors"][0]["count"].get<std::size_t>();
  for (std::size_t i = 0; i < vertices; ++i) {
    reinterpret_cast<float*>(after.element(0, i))[2] += 1e-5F * static_cast<float>(i % 3);
  }
  const auto corners = after.json["accessors"][3]["count"].get<std::size_t>();
  auto* const first = reinterpret_cast<std::uint32_t*>(after.element(3, 0));
  std::reverse(first, first + corners);
  for (std::size_t i = 0; i < corners; i += 3) std::swap(first[i], first[i + 2]);
  for (const bool back : {false, true}) {
    const CompareReport report = back ? between(after, before) : between(before, after);
    EXPECT_EQ(report.level, CompareLevel::bounds) << sentences(report);
    ASSERT_THAT(report.changes, SizeIs(1)) << sentences(report);
    EXPECT_EQ(report.changes.front().kind, "geometry.position");
  }
}

TEST(CompareSurfaces, SaysHowFarTheyAreApart) {
  const auto hill = [](float u, float v) { return u == 0.5F && v == 0.5F ? 0.25F : 0.0F; };
  const CompareReport report = between(sheet(1), sheet(4, hill));
  ASSERT_THAT(report.changes, SizeIs(1)) << sentences(report);
  EXPECT_THAT(report.changes.front().what, HasSubstr("0.25 away, at (0.5, 0.5, 0.25)"));
  ASSERT_TRUE(report.changes.front().measure);
  EXPECT_GT(report.changes.front().measure->value, 10);
}

/// A triangle that two joints in a row carry, far from both. `angle`: of each at 1 s.
EditedAsset arm(float angle) {
  const float sine = std::sin(angle / 2), cosine = std::cos(angle / 2);
  std::string bytes;
  const auto put = [&](const auto& list) {
    bytes.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(list[0]));
  };
  put(std::vector<float>{100, 0, 0, 101, 0, 0, 100, 1, 0});            // 0: POSITION
  put(std::vector<std::uint8_t>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});  // 36: JOINTS_0
  put(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});         // 48: WEIGHTS_0
  put(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,   0, 0, 1,
                         1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -50, 0, 0, 1});  // 96: matrices
  put(std::vector<float>{0, 1});                                              // 224
  put(std::vector<float>{0, 0, 0, 1, 0, 0, sine, cosine});                    // 232
  return EditedAsset::made(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
    "nodes": [{"name": "Arm", "mesh": 0, "skin": 0}, {"name": "Upper", "children": [2]},
              {"name": "Lower", "translation": [50, 0, 0]}],
    "meshes": [{"name": "hand", "primitives": [
      {"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
    "skins": [{"joints": [1, 2], "inverseBindMatrices": 3}],
    "animations": [{"name": "Wave", "samplers": [{"input": 4, "output": 5}],
      "channels": [{"sampler": 0, "target": {"node": 1, "path": "rotation"}},
                   {"sampler": 0, "target": {"node": 2, "path": "rotation"}}]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
      {"bufferView": 1, "componentType": 5121, "count": 3, "type": "VEC4"},
      {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC4"},
      {"bufferView": 3, "componentType": 5126, "count": 2, "type": "MAT4"},
      {"bufferView": 4, "componentType": 5126, "count": 2, "type": "SCALAR"},
      {"bufferView": 5, "componentType": 5126, "count": 2, "type": "VEC4"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36},
                    {"buffer": 0, "byteOffset": 36, "byteLength": 12},
                    {"buffer": 0, "byteOffset": 48, "byteLength": 48},
                    {"buffer": 0, "byteOffset": 96, "byteLength": 128},
                    {"buffer": 0, "byteOffset": 224, "byteLength": 8},
                    {"buffer": 0, "byteOffset": 232, "byteLength": 32}]})",
                           bytes);
}

TEST(ComparePoses, SeesWhatSmallTurnsOfManyJointsDoTogether) {
  CompareOptions options;
  options.bounds.animation = 1e-3;
  const CompareReport near = between(arm(0.5F), arm(0.50002F), options);
  EXPECT_EQ(near.level, CompareLevel::bounds) << sentences(near);
  const CompareReport far = between(arm(0.5F), arm(0.501F), options);
  EXPECT_EQ(far.level, CompareLevel::differs) << sentences(far);
  EXPECT_THAT(sentences(far), HasSubstr("away, 'Wave' at 1 s"));
  EXPECT_EQ(between(arm(0.5F), arm(0.5F)).level, CompareLevel::identical);
}

TEST(CompareSurfaces, TakesIndicesWithoutDataForZeros) {
  const std::string bytes(36, '\0');
  const auto points = [&](const char* indices) {
    return EditedAsset::made(fmt::format(R"({{
      "asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
      "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1, "mode": 0}}]}}],
      "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}},
                    {{{} "componentType": 5123, "count": 2, "type": "SCALAR"}}],
      "bufferViews": [{{"buffer": 0, "byteLength": 36}}, {{"buffer": 0, "byteLength": 4}}]}})",
                                         indices),
                             bytes);
  };
  EXPECT_EQ(between(points(R"("bufferView": 1,)"), points("")).level, CompareLevel::storage);
}

}  // namespace
}  // namespace gltfx::prove
