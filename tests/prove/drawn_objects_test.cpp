// SPDX-License-Identifier: Apache-2.0
/// Objects that are drawn, with CompareOptions::drawn.
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "prove/compare.hpp"
#include "prove/edited_asset.hpp"

namespace gltfx::prove {
namespace {

using test::EditedAsset;
using test::Json;

/// A lamp and a door that a clip moves, both of one mesh, a camera, a light, and what nothing uses.
EditedAsset house() {
  constexpr float kValues[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0,   // positions
                               0, 0, 1, 0, 0, 1, 1, 1,               // texture coordinates
                               0, 1,                                 // times
                               0, 0, 0, 1, 0, 0,                     // places
                               3, 0, 0, 0, 3, 0, 0, 0, 3, 1, 2, 3};  // of copies; of an application
  std::string bytes(sizeof(kValues) + 12, '\0');
  std::memcpy(bytes.data(), kValues, sizeof(kValues));
  constexpr std::uint16_t kIndices[] = {0, 1, 2, 2, 1, 3};
  std::memcpy(bytes.data() + sizeof(kValues), kIndices, sizeof(kIndices));
  return EditedAsset::made(R"({
    "asset": {"version": "2.0"},
    "extensionsUsed": ["KHR_lights_punctual", "EXT_mesh_gpu_instancing"],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}, {"type": "spot"}]}},
    "scene": 0, "scenes": [{"name": "day", "nodes": [0, 1, 2, 3, 4]},
                           {"name": "night", "nodes": [0]}],
    "nodes": [{"name": "Lamp", "mesh": 0}, {"name": "Door", "children": [5]},
              {"name": "Eye", "camera": 0, "translation": [0, 0, 5]},
              {"name": "Sun", "extensions": {"KHR_lights_punctual": {"light": 0}}},
              {"name": "Trees", "mesh": 0, "extensions": {"EXT_mesh_gpu_instancing":
                                                         {"attributes": {"TRANSLATION": 4}}}},
              {"name": "Knob", "mesh": 0, "translation": [0, 1, 0]}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "_HEAT": 5},
                                "indices": 6, "material": 0}]},
               {"name": "free", "primitives": [{"attributes": {"POSITION": 0}, "material": 2}]}],
    "materials": [{"name": "Wood"}, {"name": "Unused"}, {"name": "OfFree"}],
    "animations": [{"name": "Open", "samplers": [{"input": 2, "output": 3}],
                    "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
      {"bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 4, "type": "VEC2"},
      {"bufferView": 0, "byteOffset": 80, "componentType": 5126, "count": 2, "type": "SCALAR"},
      {"bufferView": 0, "byteOffset": 88, "componentType": 5126, "count": 2, "type": "VEC3"},
      {"bufferView": 0, "byteOffset": 112, "componentType": 5126, "count": 3, "type": "VEC3"},
      {"bufferView": 0, "byteOffset": 112, "componentType": 5126, "count": 4, "type": "SCALAR"},
      {"bufferView": 0, "byteOffset": 160, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 172}]})",
                           bytes);
}

/// Of both directions, with `drawn`: the level, and the kinds of the changes.
std::string drawn_changes(const std::function<void(EditedAsset&)>& edit) {
  const EditedAsset before = house();
  EditedAsset after = house();
  edit(after);
  CompareOptions options;
  options.drawn = true;
  const auto text_of = [&](const EditedAsset& one, const EditedAsset& other) {
    CompareReport report;
    compare_assets(one.open(), other.open(), *schema::builtin_set(), options, report);
    std::string text(compare_level_name(report.level));
    for (const Change& change : report.changes) {
      text += " " + std::string(change.kind) + " " +
              change.old_pointer.value_or(change.new_pointer.value_or(""));
    }
    return text;
  };
  std::string there = text_of(before, after);
  const std::string back = text_of(after, before);
  for (const std::string_view gone : {".removed", ".added"}) {
    if (const std::size_t at = there.find(gone); at != std::string::npos) {
      const std::string other = gone == ".removed" ? ".added" : ".removed";
      EXPECT_NE(back.find(other), std::string::npos) << back;
      return there;
    }
  }
  EXPECT_EQ(there, back);
  return there;
}

void remove_root(EditedAsset& asset, std::size_t node) {
  Json& roots = asset.json["scenes"][0]["nodes"];
  for (std::size_t i = 0; i < roots.size(); ++i) {
    if (roots[i] == node) return roots.erase(i), void();
  }
}

void remove_last_node(EditedAsset& asset) {
  asset.json["nodes"].erase(5);
  asset.json["nodes"][1].erase("children");
}

float& number(EditedAsset& asset, std::size_t accessor, std::size_t index) {
  return *reinterpret_cast<float*>(asset.element(accessor, index));
}

TEST(DrawnObjects, TellsWhatIsNoLongerDrawn) {
  EXPECT_EQ(drawn_changes(remove_last_node), "differs node.removed /nodes/5");
  EXPECT_EQ(drawn_changes([](EditedAsset& asset) { remove_root(asset, 0); }),
            "differs scene.nodes /scenes/0/nodes");
  EXPECT_EQ(drawn_changes([](EditedAsset& asset) { remove_root(asset, 3); }),
            "differs scene.nodes /scenes/0/nodes");
  EXPECT_EQ(drawn_changes([](EditedAsset& asset) { asset.json["scenes"].erase(1); }),
            "differs scene.removed /scenes/1");
  EXPECT_EQ(drawn_changes([](EditedAsset& asset) { asset.json.erase("animations"); }),
            "differs animation.removed /animations/0");
  EXPECT_EQ(drawn_changes([](EditedAsset& asset) { asset.json["nodes"][3].erase("extensions"); }),
            "differs node.value /nodes/3/extensions/KHR_lights_punctual");
  EXPECT_EQ(drawn_changes([](EditedAsset& asset) { asset.json["accessors"][4]["count"] = 2; }),
            "differs node.value "
            "/nodes/4/extensions/EXT_mesh_gpu_instancing/attributes/TRANSLATION");
}

TEST(DrawnObjects, LeavesOutWhatIsNotDrawn) {
  const std::function<void(EditedAsset&)> edits[] = {
      [](EditedAsset& asset) { asset.json["materials"][1]["doubleSided"] = true; },
      [](EditedAsset& asset) { asset.json["materials"][2]["doubleSided"] = true; },
      [](EditedAsset& asset) { asset.json["meshes"].erase(1); },
      [](EditedAsset& asset) { asset.json["nodes"][2]["translation"][2] = 6; },
      [](EditedAsset& asset) { asset.json["cameras"][0]["perspective"]["yfov"] = 0.5; },
      [](EditedAsset& asset) { remove_root(asset, 2); },
      [](EditedAsset& asset) {
        asset.json["extensions"]["KHR_lights_punctual"]["lights"][1]["intensity"] = 3;
      },
      [](EditedAsset& asset) { asset.json["accessors"][5]["byteOffset"] = 116; },
      [](EditedAsset& asset) { number(asset, 1, 2) = 0.5F; },
      [](EditedAsset& asset) {
        asset.json["nodes"].push_back({{"name", "empty"}});
        asset.json["scenes"][0]["nodes"].push_back(6);
      },
      [](EditedAsset& asset) {
        asset.json["scenes"].push_back({{"name", "empty"}});
      },
  };
  for (const auto& edit : edits) EXPECT_EQ(drawn_changes(edit), "storage");
}

TEST(DrawnObjects, SeesTheSameSurfaceInOtherNodesBelowOneThatMoves) {
  const auto flatten = [](EditedAsset& asset) {
    asset.json["nodes"].push_back({{"name", "between"}, {"children", {5}}});
    asset.json["nodes"][6]["translation"] = {0, 1, 0};
    asset.json["nodes"][5].erase("translation");
    asset.json["nodes"][1]["children"] = {6};
  };
  EXPECT_EQ(drawn_changes(flatten), "storage");
  EXPECT_EQ(drawn_changes([&](EditedAsset& asset) {
              flatten(asset);
              asset.json["nodes"][6]["translation"] = {0, 2, 0};
            }).substr(0, 7),
            "differs");
}

TEST(DrawnObjects, FollowsAClipToTheNodeThatCarriesTheMesh) {
  EditedAsset before = house();
  before.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
  before.json["nodes"][0]["translation"] = {0, 0, 1};
  before.json["animations"][0]["channels"][0]["target"] = {{"node", 0}, {"path", "weights"}};
  before.json["animations"][0]["samplers"][0]["output"] = 2;
  EditedAsset after = before;
  after.json["nodes"].push_back({{"mesh", 0}});
  after.json["nodes"][0].erase("mesh");
  after.json["nodes"][0]["children"] = {6};
  after.json["animations"][0]["channels"][0]["target"]["node"] = 6;
  for (const bool back : {false, true}) {
    CompareReport report;
    compare_assets((back ? after : before).open(), (back ? before : after).open(),
                   *schema::builtin_set(), {}, report);
    EXPECT_EQ(report.level, CompareLevel::storage) << report.changes.front().what;
  }
}

}  // namespace
}  // namespace gltfx::prove
