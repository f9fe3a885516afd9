// SPDX-License-Identifier: Apache-2.0
/// What counts with CompareOptions::drawn: what shows is told, and nothing else.
#include <array>
#include <cstring>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "prove/compare.hpp"
#include "prove/edited_asset.hpp"

namespace gltfx::prove {
namespace {

using test::EditedAsset;
using test::Json;

constexpr int kFloats = 5126;
constexpr int kShorts = 5123;

// Accessors of made_scene().
enum DrawnAccessor : std::size_t { places, normals, first_uvs, other_uvs, colors };

/// Two scenes with quads, a light, variants, an animation, and objects that nothing uses.
EditedAsset made_scene() {
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
  using Floats = std::vector<float>;
  add(Floats{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3, kFloats);
  add(Floats{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3, kFloats);
  add(Floats{0, 0, 1, 0, 1, 1, 0, 1}, "VEC2", 2, kFloats);
  add(Floats{0, 0, 1, 0, 1, 1, 0, 1}, "VEC2", 2, kFloats);
  add(Floats(16, 1), "VEC4", 4, kFloats);
  add(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 1, kShorts);
  add(Floats{0, 1}, "SCALAR", 1, kFloats);
  add(Floats{3, 0, 0, 4, 0, 0}, "VEC3", 3, kFloats);
  add(Floats(6, 1), "VEC3", 3, kFloats);
  EditedAsset asset = EditedAsset::made(R"({
    "asset": {"version": "2.0"}, "scene": 0,
    "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_variants", "EXT_lights_image_based"],
    "extensions": {
      "EXT_lights_image_based": {"lights": [{"intensity": 2}]},
      "KHR_lights_punctual": {"lights": [{"type": "point"}]},
      "KHR_materials_variants": {"variants": [{"name": "red"}, {"name": "blue"}]}},
    "scenes": [{"name": "First", "nodes": [0, 1, 2],
      "extensions": {"EXT_lights_image_based": {"light": 0}}}, {"nodes": [3]}],
    "nodes": [
      {"name": "Plain", "mesh": 0},
      {"name": "Lamp", "extensions": {"KHR_lights_punctual": {"light": 0}}},
      {"name": "Dressed", "mesh": 1, "translation": [3, 0, 0]},
      {"name": "Elsewhere", "mesh": 0, "translation": [0, 3, 0]},
      {"name": "Stored", "mesh": 0, "translation": [0, 9, 0]}],
    "materials": [
      {"name": "Grey", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1]}},
      {"name": "Red", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}},
      {"name": "Blue", "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 1, 1]}},
      {"name": "Unused", "emissiveFactor": [1, 0, 0]}],
    "meshes": [
      {"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2,
        "TEXCOORD_1": 3, "COLOR_0": 4}, "indices": 5, "material": 0}]},
      {"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 5, "material": 1,
        "extensions": {"KHR_materials_variants": {"mappings": [
          {"material": 1, "variants": [0]}, {"material": 2, "variants": [1]}]}}}]}],
    "animations": [{"name": "Slide", "samplers": [{"input": 6, "output": 7}],
      "channels": [{"sampler": 0, "target": {"node": 2, "path": "translation"}}]}]})",
                                        bytes);
  asset.json["bufferViews"] = views;
  asset.json["accessors"] = accessors;
  return asset;
}

CompareReport drawn_between(const EditedAsset& before, const EditedAsset& after) {
  CompareReport report;
  CompareOptions options;
  options.drawn = true;
  compare_assets(before.open(), after.open(), *schema::builtin_set(), options, report);
  return report;
}

std::string drawn_text(const CompareReport& report) {
  std::string text(compare_level_name(report.level));
  for (const Change& change : report.changes) {
    text += "\n  " + std::string(change.kind) + ": " + change.what;
  }
  return text;
}

void set_component(EditedAsset& asset, std::size_t accessor, std::size_t vertex,
                   std::size_t component, float value) {
  std::memcpy(asset.element(accessor, vertex) + component * sizeof(float), &value, sizeof(value));
}

Json& attributes_of(EditedAsset& asset) {
  return asset.json["meshes"][0]["primitives"][0]["attributes"];
}
Json& mappings_of(EditedAsset& asset) {
  return asset
      .json["meshes"][1]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"];
}

struct DrawnEdit {
  const char* name;
  std::function<void(EditedAsset&)> make;
};

const DrawnEdit kUnseenEdits[] = {
    {"colors that are white", [](EditedAsset& a) { attributes_of(a).erase("COLOR_0"); }},
    {"alpha of colors of an opaque material",
     [](EditedAsset& a) { set_component(a, colors, 0, 3, 0.5F); }},
    {"texture coordinates that nothing reads",
     [](EditedAsset& a) { set_component(a, other_uvs, 0, 0, 7); }},
    {"all of them",
     [](EditedAsset& a) {
       attributes_of(a).erase("TEXCOORD_0");
       attributes_of(a).erase("TEXCOORD_1");
     }},
    {"normals of a plane", [](EditedAsset& a) { attributes_of(a).erase("NORMAL"); }},
    {"a material that nothing uses",
     [](EditedAsset& a) {
       a.json["materials"][3]["emissiveFactor"] = {0, 1, 0};
     }},
    {"a node in no scene",
     [](EditedAsset& a) {
       a.json["nodes"][4]["translation"] = {0, 5, 0};
     }},
    {"names",
     [](EditedAsset& a) {
       a.json["scenes"][0]["name"] = "Other";
       a.json["animations"][0]["name"] = "Other";
       a.json["materials"][0]["name"] = "Other";
     }},
    {"a camera",
     [](EditedAsset& a) {
       a.json["cameras"] = {
           {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
       a.json["nodes"][0]["camera"] = 0;
     }},
    {"a coat without strength",
     [](EditedAsset& a) {
       a.json["materials"][0]["extensions"]["KHR_materials_clearcoat"] = {
           {"clearcoatFactor", 0}, {"clearcoatRoughnessFactor", 0.5}};
     }},
    {"emission in other parts",
     [](EditedAsset& a) {
       a.json["materials"][0]["extensions"]["KHR_materials_emissive_strength"] = {
           {"emissiveStrength", 2}};
     }},
    {"a cutoff without a mask",
     [](EditedAsset& a) { a.json["materials"][0]["alphaCutoff"] = 0.3; }},
    {"the order of mappings",
     [](EditedAsset& a) { std::swap(mappings_of(a)[0], mappings_of(a)[1]); }},
    {"an extension about something else",
     [](EditedAsset& a) {
       a.json["nodes"][0]["extensions"]["KHR_node_selectability"] = {{"selectable", false}};
     }},
    {"visibility that is there anyway",
     [](EditedAsset& a) {
       a.json["nodes"][0]["extensions"]["KHR_node_visibility"] = {{"visible", true}};
     }},
    {"metadata, as the schema of its extension states",
     [](EditedAsset& a) {
       a.json["nodes"][0]["extensions"]["KHR_xmp_json_ld"] = {{"packet", 0}};
     }},
    {"a channel that moves nothing",
     [](EditedAsset& a) {
       a.json["animations"][0]["samplers"].push_back({{"input", 6}, {"output", 8}});
       a.json["animations"][0]["channels"].push_back(
           {{"sampler", 1}, {"target", {{"node", 2}, {"path", "scale"}}}});
     }},
    {"a node between the scene and others",
     [](EditedAsset& a) {
       a.json["nodes"].push_back({{"children", {1, 2}}});
       a.json["scenes"][0]["nodes"] = {0, 5};
     }},
};

const DrawnEdit kSeenEdits[] = {
    {"a node that left its scene",
     [](EditedAsset& a) {
       a.json["scenes"][0]["nodes"] = {1, 2};
     }},
    {"a light", [](EditedAsset& a) { a.json["nodes"][1].erase("extensions"); }},
    {"the node of a light",
     [](EditedAsset& a) {
       a.json["scenes"][0]["nodes"] = {0, 2};
     }},
    {"a scene", [](EditedAsset& a) { a.json["scenes"].erase(1); }},
    {"the scene that is shown first", [](EditedAsset& a) { a.json["scene"] = 1; }},
    {"animations", [](EditedAsset& a) { a.json.erase("animations"); }},
    {"materials of variants",
     [](EditedAsset& a) {
       std::swap(mappings_of(a)[0]["material"], mappings_of(a)[1]["material"]);
     }},
    {"variants",
     [](EditedAsset& a) {
       a.json["meshes"][1]["primitives"][0].erase("extensions");
       a.json["extensions"].erase("KHR_materials_variants");
     }},
    {"a color", [](EditedAsset& a) { set_component(a, colors, 0, 0, 0.5F); }},
    {"a place", [](EditedAsset& a) { set_component(a, places, 0, 0, 0.1F); }},
    {"normals", [](EditedAsset& a) { set_component(a, normals, 0, 0, 1); }},
    {"light of a scene", [](EditedAsset& a) { a.json["scenes"][0].erase("extensions"); }},
    {"both sides", [](EditedAsset& a) { a.json["materials"][0]["doubleSided"] = true; }},
    {"a coat",
     [](EditedAsset& a) {
       a.json["materials"][0]["extensions"]["KHR_materials_clearcoat"] = {{"clearcoatFactor", 1}};
     }},
    {"alpha", [](EditedAsset& a) { a.json["materials"][0]["alphaMode"] = "BLEND"; }},
    {"visibility",
     [](EditedAsset& a) {
       a.json["nodes"][0]["extensions"]["KHR_node_visibility"] = {{"visible", false}};
     }},
};

TEST(CompareDrawn, SaysNothingOfWhatDoesNotShow) {
  const EditedAsset scene = made_scene();
  for (const DrawnEdit& edit : kUnseenEdits) {
    EditedAsset edited = scene;
    edit.make(edited);
    for (const bool back : {false, true}) {
      const CompareReport report =
          back ? drawn_between(edited, scene) : drawn_between(scene, edited);
      EXPECT_EQ(report.level, CompareLevel::storage) << edit.name << ": " << drawn_text(report);
    }
  }
}

TEST(CompareDrawn, TellsAllThatShows) {
  const EditedAsset scene = made_scene();
  for (const DrawnEdit& edit : kSeenEdits) {
    EditedAsset edited = scene;
    edit.make(edited);
    for (const bool back : {false, true}) {
      const CompareReport report =
          back ? drawn_between(edited, scene) : drawn_between(scene, edited);
      EXPECT_EQ(report.level, CompareLevel::differs) << edit.name << ": " << drawn_text(report);
    }
  }
}

TEST(CompareDrawn, NamesWhatIsGone) {
  EditedAsset edited = made_scene();
  edited.json["nodes"][1].erase("extensions");
  EXPECT_THAT(drawn_text(drawn_between(made_scene(), edited)),
              testing::HasSubstr("node.value: KHR_lights_punctual was removed"));
  edited = made_scene();
  edited.json.erase("animations");
  EXPECT_THAT(drawn_text(drawn_between(made_scene(), edited)),
              testing::HasSubstr("animation.removed"));
}

/// Squares without normals along x, with their triangles in that order. `noise`: added to places.
EditedAsset row_of_squares(const std::vector<float>& order, float noise) {
  std::vector<float> corners;
  for (const float x : order) {
    const std::array<std::array<float, 2>, 6> square{
        {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}};
    for (const auto& corner : square) {
      corners.insert(corners.end(), {x + corner[0] + noise, corner[1], 0});
    }
  }
  std::string bytes(reinterpret_cast<const char*>(corners.data()), corners.size() * sizeof(float));
  EditedAsset asset = EditedAsset::made(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]})",
                                        bytes);
  asset.json["bufferViews"] = {{{"buffer", 0}, {"byteLength", bytes.size()}}};
  asset.json["accessors"] = {{{"bufferView", 0},
                              {"componentType", kFloats},
                              {"count", corners.size() / 3},
                              {"type", "VEC3"}}};
  return asset;
}

TEST(CompareDrawn, PairsTrianglesByTheirPlace) {
  const EditedAsset before = row_of_squares({0, 2, 4, 6, 8}, 0);
  const EditedAsset after = row_of_squares({8, 4, 0, 6, 2}, 1e-5F);
  const CompareReport report = drawn_between(before, after);
  EXPECT_EQ(report.level, CompareLevel::bounds) << drawn_text(report);
}

TEST(CompareDrawn, SaysWhatDiffersInTheSceneIfNodesMakeUpForTheirMeshes) {
  EditedAsset before = row_of_squares({0, 2}, 0);
  before.json["nodes"][0]["translation"] = {100, 0, 0};
  EditedAsset after = row_of_squares({100, 102}, 0.25F);
  const CompareReport report = drawn_between(before, after);
  EXPECT_EQ(report.level, CompareLevel::differs);
  EXPECT_THAT(drawn_text(report), testing::HasSubstr("0.25"));
  EXPECT_THAT(drawn_text(report), testing::Not(testing::HasSubstr("node.moved")));
}

}  // namespace
}  // namespace gltfx::prove
