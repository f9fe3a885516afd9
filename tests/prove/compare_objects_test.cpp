// SPDX-License-Identifier: Apache-2.0
/// Objects that took the name, the place or the values of others, and what only some readers see.
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "prove/compare.hpp"
#include "prove/edited_asset.hpp"

namespace gltfx::prove {
namespace {

using test::EditedAsset;
using test::Json;

/// Two meshes with colors, a texture with a sampler, and values of a property table.
EditedAsset board() {
  constexpr float kValues[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0,  // positions
                               1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1,  // three numbers of colors
                               1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1,  // the same with alpha
                               1, 1, 1, 1, 5, 6};                   // and two of a table
  constexpr std::uint16_t kIndices[] = {0, 1, 2, 2, 1, 3, 2, 1, 3, 0, 1, 2};
  std::string bytes(sizeof(kValues) + sizeof(kIndices), '\0');
  std::memcpy(bytes.data(), kValues, sizeof(kValues));
  std::memcpy(bytes.data() + sizeof(kValues), kIndices, sizeof(kIndices));
  return EditedAsset::made(R"({
    "asset": {"version": "2.0"}, "extensionsUsed": ["EXT_structural_metadata"],
    "extensions": {"EXT_structural_metadata": {
      "schema": {"id": "s", "classes": {"tree": {"properties": {
        "h": {"type": "SCALAR", "componentType": "FLOAT32"}}}}},
      "propertyTables": [{"class": "tree", "count": 2, "properties": {"h": {"values": 1}}}]}},
    "scene": 0, "scenes": [{"nodes": [0, 1]}],
    "nodes": [{"name": "A", "mesh": 0, "extras": {"sizes": [1, 2, 3]}},
              {"name": "B", "mesh": 1, "translation": [2, 0, 0]}],
    "meshes": [{"name": "a", "primitives": [{"attributes": {"POSITION": 0, "COLOR_0": 1},
                                             "indices": 3, "material": 0}]},
               {"name": "b", "primitives": [{"attributes": {"POSITION": 0}, "material": 2,
                                             "indices": 3}]}],
    "materials": [{"name": "Red", "alphaMode": "BLEND", "pbrMetallicRoughness":
                    {"baseColorTexture": {"index": 0}}},
                  {"name": "Glass", "doubleSided": true},
                  {"name": "Red.001", "pbrMetallicRoughness": {"roughnessFactor": 0.5}},
                  {"name": "Red.001", "pbrMetallicRoughness": {"roughnessFactor": 0.5}}],
    "textures": [{"sampler": 0, "source": 0}],
    "samplers": [{"wrapS": 33071}, {"magFilter": 9728, "minFilter": 9728}],
    "images": [{"uri": "data:image/png;base64,AAAA", "mimeType": "image/png"}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
      {"bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 4, "type": "VEC3"},
      {"bufferView": 0, "byteOffset": 96, "componentType": 5126, "count": 4, "type": "VEC4"},
      {"bufferView": 0, "byteOffset": 168, "componentType": 5123, "count": 6, "type": "SCALAR"},
      {"bufferView": 0, "byteOffset": 180, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 192},
                    {"buffer": 0, "byteOffset": 160, "byteLength": 8}]})",
                           bytes);
}

std::string changes_of(const EditedAsset& before, const EditedAsset& after,
                       const CompareOptions& options = {}) {
  CompareReport report;
  compare_assets(before.open(), after.open(), *schema::builtin_set(), options, report);
  std::string text(compare_level_name(report.level));
  for (const Change& change : report.changes) {
    text += "; " + std::string(change.kind) + " " +
            change.old_pointer.value_or(change.new_pointer.value_or("")) + " " + change.what;
  }
  for (const std::string& each : report.unproven) text += "; unproven " + each;
  return text;
}

std::string changes_of(const std::function<void(Json&)>& edit, const CompareOptions& options = {}) {
  EditedAsset after = board();
  edit(after.json);
  return changes_of(board(), after, options);
}

TEST(CompareObjects, FollowsNamesThatWereExchanged) {
  EXPECT_EQ(changes_of([](Json& json) {
              std::swap(json["materials"][0]["name"], json["materials"][1]["name"]);
            }),
            "differs; material.renamed /materials/0/name renamed \"Red\" -> \"Glass\"; "
            "material.renamed /materials/1/name renamed \"Glass\" -> \"Red\"");
  EXPECT_EQ(
      changes_of([](Json& json) { std::swap(json["nodes"][0]["name"], json["nodes"][1]["name"]); }),
      "differs; node.renamed /nodes/0/name renamed \"A\" -> \"B\"; "
      "node.renamed /nodes/1/name renamed \"B\" -> \"A\"");
}

TEST(CompareObjects, TakesOneMaterialForAnEqualOne) {
  EXPECT_EQ(changes_of([](Json& json) { json["meshes"][1]["primitives"][0]["material"] = 3; }),
            "storage");
  EXPECT_EQ(changes_of([](Json& json) { json["meshes"][1]["primitives"][0]["material"] = 1; }),
            "differs; geometry.material /meshes/1/primitives/0/material uses 'Glass' instead of "
            "'Red.001'");
}

TEST(CompareObjects, TakesColorsWithoutAlphaForOpaqueOnes) {
  EXPECT_EQ(changes_of([](Json& json) {
              json["accessors"][1]["byteOffset"] = 96;
              json["accessors"][1]["type"] = "VEC4";
            }),
            "storage");
}

TEST(CompareObjects, SeesTheOrderOfTrianglesThatBlend) {
  EXPECT_EQ(changes_of([](Json& json) { json["meshes"][1]["primitives"][0]["indices"] = 4; }),
            "storage");
  EXPECT_EQ(changes_of([](Json& json) { json["meshes"][0]["primitives"][0]["indices"] = 4; }),
            "differs; geometry.elements /meshes/0/primitives/0/indices triangles have another "
            "order, which shows because the material blends");
}

TEST(CompareObjects, ComparesDataOfExtensionsExactly) {
  EditedAsset after = board();
  const float other = 6.5F;
  std::memcpy(after.files.at("buffer0.bin").data() + 164, &other, 4);
  EXPECT_EQ(changes_of(board(), after),
            "differs; object.value "
            "/extensions/EXT_structural_metadata/propertyTables/0/properties/h/values "
            "values leads to other data");
}

TEST(CompareObjects, NamesTheMostSpecificValue) {
  EXPECT_EQ(changes_of([](Json& json) { json["nodes"][0]["extras"]["sizes"][1] = 4; }),
            "differs; extras /nodes/0/extras/sizes/1 sizes [1, 2, 3] -> [1, 4, 3]");
  EXPECT_EQ(changes_of([](Json& json) {
              json["materials"][1]["extensions"]["KHR_materials_unlit"] = Json::object();
            }),
            "differs; material.value /materials/1/extensions/KHR_materials_unlit "
            "KHR_materials_unlit was added");
  EXPECT_EQ(changes_of([](Json& json) { json["textures"][0]["sampler"] = 1; }),
            "differs; texture.value /textures/0/sampler uses another sampler: wrapS 33071 -> "
            "none, magFilter none -> 9728, minFilter none -> 9728");
}

TEST(CompareObjects, CountsTheOrderOfListsOnRequest) {
  const auto edit = [](Json& json) {
    std::swap(json["scenes"][0]["nodes"][0], json["scenes"][0]["nodes"][1]);
  };
  EXPECT_EQ(changes_of(edit), "storage");
  CompareOptions options;
  options.count.insert("order");
  EXPECT_EQ(changes_of(edit, options),
            "differs; order /scenes/0/nodes 1 of 2 elements come in another order");
  EXPECT_EQ(changes_of([](Json& json) { json["asset"]["generator"] = "x"; }, options), "storage");
}

TEST(CompareObjects, ComparesPrimitivesOfOtherModesInOrder) {
  EditedAsset before = board();
  before.json["meshes"][1]["primitives"][0]["mode"] = 100;
  EditedAsset after = before;
  after.json["meshes"][1]["name"] = "c";
  EXPECT_EQ(changes_of(before, after),
            "differs; mesh.renamed /meshes/1/name renamed \"b\" -> \"c\"");
  after = before;
  after.json["meshes"][1]["primitives"][0]["indices"] = 4;
  EXPECT_EQ(changes_of(before, after),
            "differs; geometry.elements /meshes/1/primitives/0/indices indices has other values");
  after = before;
  after.json["meshes"][1]["primitives"][0]["mode"] = 101;
  EXPECT_EQ(changes_of(before, after),
            "differs; geometry.elements /meshes/1/primitives/0/mode mode has other values");
}

TEST(CompareObjects, TellsExtrasOfExtensionsThatStoreData) {
  EditedAsset before = board();
  before.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
      {"buffer", 0}, {"byteLength", 4}, {"extras", {{"by", "me"}}}};
  EditedAsset after = before;
  after.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["extras"]["by"] = "you";
  EXPECT_THAT(changes_of(before, after),
              testing::HasSubstr("stored.name /bufferViews/0/extensions/EXT_meshopt_compression"));
}

TEST(CompareObjects, TellsAJointInThePlaceOfAnotherOne) {
  const EditedAsset before =
      EditedAsset::load(std::filesystem::path(GLTFX_SOURCE_DIR) / "fixtures/good/reed.gltf");
  EditedAsset after = before;
  Json& joints = after.json["skins"][0]["joints"];
  joints[1] = joints[0];
  for (const bool back : {false, true}) {
    const std::string text = back ? changes_of(after, before) : changes_of(before, after);
    EXPECT_THAT(text, testing::HasSubstr("; skin.joints /skins/0/joints "));
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("skin.bind")));
  }
}

}  // namespace
}  // namespace gltfx::prove
