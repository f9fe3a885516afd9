// SPDX-License-Identifier: Apache-2.0
#include "model/info.hpp"

#include <gtest/gtest.h>

#include "asset_text.hpp"

namespace gltfx::model {
namespace {

using test::AssetText;
using Names = std::vector<std::string>;

TEST(AssetInfo, TakesTheHeaderAndTheListsOfExtensionsOnceEach) {
  const AssetText text(R"({"asset": {"version": "2.0", "minVersion": "2.0", "generator": "hand"},
    "extensionsUsed": ["A_x", "B_y", "A_x", 5], "extensionsRequired": ["B_y"]})");
  const AssetInfo info = asset_info(text.asset, Views(text.asset));
  EXPECT_EQ(info.version, "2.0");
  EXPECT_EQ(info.min_version, "2.0");
  EXPECT_EQ(info.generator, "hand");
  EXPECT_EQ(info.extensions_used, (Names{"A_x", "B_y"}));
  EXPECT_EQ(info.extensions_required, (Names{"B_y"}));
}

TEST(AssetInfo, CountsTrianglesByMode) {
  const auto triangles = [](const std::string& primitive) {
    const AssetText text(
        R"({"accessors": [{"count": 7}, {"count": 2}], "meshes": [{"primitives": [)" + primitive +
        "]}]}");
    return asset_info(text.asset, Views(text.asset)).total_triangle_count;
  };
  EXPECT_EQ(triangles(R"({"attributes": {"POSITION": 0}})"), 2U);
  EXPECT_EQ(triangles(R"({"attributes": {"POSITION": 0}, "mode": 5})"), 5U);
  EXPECT_EQ(triangles(R"({"attributes": {"POSITION": 0}, "mode": 6})"), 5U);
  EXPECT_EQ(triangles(R"({"attributes": {"POSITION": 1}, "mode": 6})"), 0U);
  EXPECT_EQ(triangles(R"({"attributes": {"POSITION": 0}, "mode": 1})"), 0U);
  EXPECT_EQ(triangles(R"({"attributes": {"POSITION": 1}, "indices": 0, "mode": 4})"), 2U);
  EXPECT_EQ(triangles(R"({"attributes": {"POSITION": 1}, "indices": 0, "mode": 9})"), 0U);
}

TEST(AssetInfo, CountsAttributesThatLeadSomewhereWhateverTheirName) {
  const AssetText text(R"({"accessors": [{"count": 3}], "meshes": [
    {"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 9, "TEXCOORD_0": 0, "TEXCOORD_1": 0,
      "JOINTS_0": 0, "WEIGHTS_0": 0, "X_y:A": 0, "WRONG": 0}}]},
    {"primitives": [{"attributes": {"_A": 0}, "targets": [{"_A": 0}]}, {"attributes": {"TEXCOORD_5": 0}}]}]})");
  const AssetInfo info = asset_info(text.asset, Views(text.asset));
  EXPECT_EQ(info.draw_call_count, 3U);
  EXPECT_EQ(info.total_vertex_count, 9U);
  EXPECT_EQ(info.max_attributes, 7U);
  EXPECT_EQ(info.max_uvs, 2U);
  EXPECT_EQ(info.max_influences, 4U);
  EXPECT_TRUE(info.has_morph_targets);
}

TEST(AssetInfo, JointsWithoutWeightsInfluenceNothing) {
  const AssetText text(
      R"({"accessors": [{"count": 3}], "meshes": [{"primitives": [{"attributes": {"JOINTS_0": 0}}]}]})");
  EXPECT_EQ(asset_info(text.asset, Views(text.asset)).max_influences, 0U);
}

TEST(AssetInfo, SaysWhatIsThere) {
  const AssetText text(R"({"scene": 0, "scenes": [{}], "skins": [{}], "textures": [{}],
    "animations": [{}, {}], "materials": [{}]})");
  const AssetInfo info = asset_info(text.asset, Views(text.asset));
  EXPECT_TRUE(info.has_default_scene);
  EXPECT_TRUE(info.has_skins);
  EXPECT_TRUE(info.has_textures);
  EXPECT_FALSE(info.has_morph_targets);
  EXPECT_EQ(info.animation_count, 2U);
  EXPECT_EQ(info.material_count, 1U);
}

TEST(AssetInfo, AHoleInAnArrayOrAMissingRootIsNoMatter) {
  const AssetText holes(R"({"meshes": [5, {"primitives": [null]}], "scene": 3})");
  EXPECT_EQ(asset_info(holes.asset, Views(holes.asset)).draw_call_count, 0U);
  EXPECT_EQ(asset_info(AssetText("[]").asset, {}).version, "");
  EXPECT_EQ(asset_info(AssetText("{").asset, {}).version, "");
}

TEST(AssetInfo, SumsOfHugeCountsDoNotWrap) {
  std::string primitives = R"({"attributes": {"POSITION": 0}})";
  for (int i = 0; i < 4096; ++i) primitives += R"(,{"attributes": {"POSITION": 0}})";
  const AssetText text(
      R"({"accessors": [{"count": 9007199254740991}], "meshes": [{"primitives": [)" + primitives +
      "]}]}");
  EXPECT_EQ(asset_info(text.asset, Views(text.asset)).total_vertex_count, UINT64_MAX);
}

}  // namespace
}  // namespace gltfx::model
