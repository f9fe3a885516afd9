// SPDX-License-Identifier: Apache-2.0
/// What changed between two assets: levels, one change for one edit, symmetry.
#include "prove/compare.hpp"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "prove/changes.hpp"
#include "prove/edited_asset.hpp"

namespace gltfx::prove {
namespace {

using test::EditedAsset;
using test::Json;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

const std::filesystem::path kCompared = std::filesystem::path(GLTFX_SOURCE_DIR) / "fixtures";

CompareReport changes_between(const EditedAsset& before, const EditedAsset& after,
                              const CompareOptions& options = {}) {
  CompareReport report;
  compare_assets(before.open(), after.open(), *schema::builtin_set(), options, report);
  return report;
}

std::string words(const CompareReport& report) {
  std::string text(compare_level_name(report.level));
  for (const Change& change : report.changes) {
    text += "\n  " + std::string(change.kind) + " " + change.old_pointer.value_or("null") + " " +
            change.new_pointer.value_or("null") + ": " + change.what;
  }
  for (const std::string& each : report.unproven) text += "\n  unproven: " + each;
  return text;
}

/// Two nodes with one triangle each, two materials, a clip.
EditedAsset small_asset() {
  std::string bytes(3 * 12 + 3 * 12 + 2 * 4 + 2 * 12, '\0');
  const auto put = [&](std::size_t at, std::vector<float> values) {
    std::memcpy(bytes.data() + at, values.data(), values.size() * sizeof(float));
  };
  put(0, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  put(36, {0, 0, 1, 2, 0, 1, 0, 2, 1});
  put(72, {0, 1});
  put(80, {0, 0, 0, 1, 2, 3});
  EditedAsset asset = EditedAsset::made(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
    "nodes": [{"name": "Door", "mesh": 0}, {"name": "Wall", "mesh": 1, "children": [2]},
              {"name": "Lock", "translation": [1, 0, 0]}],
    "meshes": [{"name": "door", "primitives": [{"attributes": {"POSITION": 0}, "material": 0}]},
               {"name": "wall", "primitives": [{"attributes": {"POSITION": 1}, "material": 1}]}],
    "materials": [{"name": "Red", "pbrMetallicRoughness": {"roughnessFactor": 0.25}},
                  {"name": "Blue", "extras": {"shop": "B-1"}}],
    "animations": [{"name": "Open", "samplers": [{"input": 2, "output": 3}],
                    "channels": [{"sampler": 0, "target": {"node": 2, "path": "translation"}}]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
       "min": [0, 0, 0], "max": [1, 1, 0]},
      {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3",
       "min": [0, 0, 1], "max": [2, 2, 1]},
      {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR",
       "min": [0], "max": [1]},
      {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36},
                    {"buffer": 0, "byteOffset": 36, "byteLength": 36},
                    {"buffer": 0, "byteOffset": 72, "byteLength": 8},
                    {"buffer": 0, "byteOffset": 80, "byteLength": 24}]})",
                                        bytes);
  return asset;
}

void set_float(EditedAsset& asset, std::size_t accessor, std::size_t element, std::size_t component,
               float value) {
  std::memcpy(asset.element(accessor, element) + component * sizeof(float), &value, sizeof(value));
}

struct Edit {
  std::string name;
  std::function<void(EditedAsset&)> edit;
  std::string kind, pointer;
};

std::vector<Edit> edits() {
  const auto set = [](std::string pointer, Json value) {
    return
        [pointer, value](EditedAsset& asset) { asset.json[Json::json_pointer(pointer)] = value; };
  };
  return {
      {"moved", set("/nodes/2/translation", {1, 0.5, 0}), "node.moved", "/nodes/2/translation"},
      {"renamed node", set("/nodes/0/name", "Gate"), "node.renamed", "/nodes/0/name"},
      {"renamed material", set("/materials/1/name", "Sea"), "material.renamed",
       "/materials/1/name"},
      {"factor", set("/materials/0/pbrMetallicRoughness/roughnessFactor", 0.5), "material.value",
       "/materials/0/pbrMetallicRoughness/roughnessFactor"},
      {"extras", set("/materials/1/extras/shop", "B-2"), "extras", "/materials/1/extras/shop"},
      {"copyright", set("/asset/copyright", "us"), "asset.value", "/asset/copyright"},
      {"vertex", [](EditedAsset& asset) { set_float(asset, 0, 1, 0, 1.5F); }, "geometry.position",
       "/meshes/0/primitives/0/attributes/POSITION"},
      {"key", [](EditedAsset& asset) { set_float(asset, 3, 1, 2, 4); }, "animation.curve",
       "/animations/0/samplers/0/output"},
      {"later",
       [](EditedAsset& asset) {
         set_float(asset, 2, 0, 0, 0.5F);
         set_float(asset, 2, 1, 0, 1.5F);
       },
       "animation.shifted", "/animations/0/samplers/0/input"},
      {"stepped", set("/animations/0/samplers/0/interpolation", "STEP"), "animation.interpolation",
       "/animations/0/samplers/0/interpolation"},
      {"material of a primitive", set("/meshes/0/primitives/0/material", 1), "geometry.material",
       "/meshes/0/primitives/0/material"},
      {"hung elsewhere",
       [](EditedAsset& asset) {
         asset.json["nodes"][1].erase("children");
         asset.json["nodes"][0]["children"] = {2};
       },
       "node.parent", "/nodes/2"},
      {"added node",
       [](EditedAsset& asset) {
         asset.json["nodes"].push_back({{"name", "New"}});
         asset.json["scenes"][0]["nodes"].push_back(3);
       },
       "node.added", "/nodes/3"},
      {"target", set("/animations/0/channels/0/target/path", "scale"), "animation.channel",
       "/animations/0/channels/0"},
      {"winding",
       [](EditedAsset& asset) {
         set_float(asset, 0, 1, 0, 0);
         set_float(asset, 0, 1, 1, 1);
         set_float(asset, 0, 2, 0, 1);
         set_float(asset, 0, 2, 1, 0);
       },
       "geometry.winding", "/meshes/0/primitives/0"},
  };
}

TEST(Compare, TellsOneEditAsOneChangeAtItsValue) {
  const EditedAsset before = small_asset();
  for (const Edit& each : edits()) {
    SCOPED_TRACE(each.name);
    EditedAsset after = before;
    each.edit(after);
    const CompareReport report = changes_between(before, after);
    ASSERT_THAT(report.changes, SizeIs(1)) << words(report);
    const Change& change = report.changes.front();
    EXPECT_EQ(change.kind, each.kind) << words(report);
    EXPECT_EQ(change.new_pointer.value_or("null"), each.pointer) << words(report);
    EXPECT_EQ(report.level, CompareLevel::differs) << words(report);
    EXPECT_FALSE(change.what.empty());
  }
}

TEST(Compare, GivesTheSameAnswerExchanged) {
  const EditedAsset before = small_asset();
  for (const Edit& each : edits()) {
    SCOPED_TRACE(each.name);
    EditedAsset after = before;
    each.edit(after);
    const CompareReport there = changes_between(before, after);
    const CompareReport back = changes_between(after, before);
    EXPECT_EQ(there.level, back.level);
    ASSERT_EQ(there.changes.size(), back.changes.size()) << words(there) << words(back);
    EXPECT_EQ(there.changes.front().old_pointer, back.changes.front().new_pointer);
    EXPECT_EQ(there.changes.front().new_pointer, back.changes.front().old_pointer);
  }
}

TEST(Compare, HasKindsThatAreKnown) {
  for (const Edit& each : edits()) EXPECT_NE(find_change_kind(each.kind), nullptr) << each.kind;
  EXPECT_EQ(find_change_kind("node"), nullptr);
  for (const ChangeKind& kind : change_kinds()) EXPECT_FALSE(kind.meaning.empty()) << kind.name;
}

// Nodes, meshes, materials and accessors in another order.
EditedAsset renumbered(const EditedAsset& asset) {
  EditedAsset other = asset;
  const auto reverse = [&](const char* list) {
    std::reverse(other.json[list].begin(), other.json[list].end());
    return other.json[list].size() - 1;
  };
  const std::size_t nodes = reverse("nodes");
  const std::size_t meshes = reverse("meshes");
  const std::size_t materials = reverse("materials");
  const std::size_t accessors = reverse("accessors");
  const auto turn = [](Json& index, std::size_t last) { index = last - index.get<std::size_t>(); };
  for (Json& node : other.json["nodes"]) {
    if (node.contains("mesh")) turn(node["mesh"], meshes);
    if (!node.contains("children")) continue;
    for (Json& child : node["children"]) turn(child, nodes);
  }
  for (Json& root : other.json["scenes"][0]["nodes"]) turn(root, nodes);
  for (Json& mesh : other.json["meshes"]) {
    for (Json& primitive : mesh["primitives"]) {
      turn(primitive["material"], materials);
      for (Json& attribute : primitive["attributes"]) turn(attribute, accessors);
    }
  }
  for (Json& animation : other.json["animations"]) {
    for (Json& sampler : animation["samplers"]) {
      turn(sampler["input"], accessors);
      turn(sampler["output"], accessors);
    }
    for (Json& channel : animation["channels"]) turn(channel["target"]["node"], nodes);
  }
  return other;
}

TEST(Compare, FindsObjectsThatWereRenumbered) {
  const EditedAsset before = small_asset();
  const CompareReport same = changes_between(before, renumbered(before));
  EXPECT_EQ(same.level, CompareLevel::storage) << words(same);
  for (const Edit& each : edits()) {
    SCOPED_TRACE(each.name);
    EditedAsset after = before;
    each.edit(after);
    const CompareReport report = changes_between(before, renumbered(after));
    ASSERT_THAT(report.changes, SizeIs(1)) << words(report);
    EXPECT_EQ(report.changes.front().kind, each.kind) << words(report);
  }
}

TEST(Compare, KnowsThatOtherStorageIsNoChange) {
  const EditedAsset before = small_asset();
  const std::vector<std::function<void(Json&)>> rewrites{
      [](Json& json) { json["materials"][0]["alphaMode"] = "OPAQUE"; },
      [](Json& json) {
        json["materials"][0]["emissiveFactor"] = {0, 0, 0};
      },
      [](Json& json) {
        json["nodes"][2]["rotation"] = {0, 0, 0, -1};
      },
      [](Json& json) {
        json["nodes"][2].erase("translation");
        json["nodes"][2]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1};
      },
      [](Json& json) { json["asset"]["generator"] = "another"; },
      [](Json& json) { std::swap(json["scenes"][0]["nodes"][0], json["scenes"][0]["nodes"][1]); },
      [](Json& json) { json["bufferViews"][0]["target"] = 34962; },
      [](Json& json) { json["meshes"][0]["primitives"][0]["mode"] = 4; },
  };
  for (std::size_t i = 0; i < rewrites.size(); ++i) {
    EditedAsset after = before;
    rewrites[i](after.json);
    const CompareReport report = changes_between(before, after);
    EXPECT_EQ(report.level, CompareLevel::storage) << i << " " << words(report);
    EXPECT_THAT(report.changes, IsEmpty()) << i;
  }
}

TEST(Compare, SeesAScaleOfALeafThatMovedIntoItsMesh) {
  const EditedAsset before = small_asset();
  EditedAsset after = before;
  after.json["nodes"][0]["scale"] = {0.5, 0.5, 0.5};
  const CompareReport moved = changes_between(before, after);
  EXPECT_EQ(moved.level, CompareLevel::differs);
  set_float(after, 0, 1, 0, 2);
  set_float(after, 0, 2, 1, 2);
  const CompareReport report = changes_between(before, after);
  EXPECT_EQ(report.level, CompareLevel::storage) << words(report);
}

TEST(Compare, ClassifiesByBounds) {
  const EditedAsset before = small_asset();
  EditedAsset after = before;
  set_float(after, 0, 1, 0, 1.0001F);
  CompareOptions options;
  EXPECT_EQ(changes_between(before, after, options).level, CompareLevel::bounds);
  options.bounds.position = 1e-6;
  EXPECT_EQ(changes_between(before, after, options).level, CompareLevel::differs);
}

TEST(Compare, LeavesOutWhatIsNotCounted) {
  const EditedAsset before = small_asset();
  EditedAsset after = before;
  after.json["nodes"][0]["name"] = "Gate";
  after.json["asset"]["generator"] = "another";
  CompareOptions options;
  options.ignore = {"node.renamed"};
  EXPECT_EQ(changes_between(before, after, options).level, CompareLevel::storage);
  options.count = {"generator"};
  EXPECT_THAT(changes_between(before, after, options).changes, SizeIs(1));
  options = {};
  options.drawn = true;
  EXPECT_EQ(changes_between(before, after, options).level, CompareLevel::storage);
}

TEST(Compare, DrawsTheSameWhenMeshesAreJoined) {
  const EditedAsset before = small_asset();
  EditedAsset after = before;
  after.json["nodes"] = {{{"mesh", 0}}, {{"name", "Lock"}, {"translation", {1, 0, 0}}}};
  after.json["scenes"][0]["nodes"] = {0, 1};
  after.json["meshes"] = {{{"primitives",
                            {{{"attributes", {{"POSITION", 0}}}, {"material", 0}},
                             {{"attributes", {{"POSITION", 1}}}, {"material", 1}}}}}};
  after.json["animations"][0]["channels"][0]["target"]["node"] = 1;
  EXPECT_EQ(changes_between(before, after).level, CompareLevel::differs);
  CompareOptions options;
  options.drawn = true;
  const CompareReport report = changes_between(before, after, options);
  EXPECT_EQ(report.level, CompareLevel::storage) << words(report);
}

TEST(Compare, DoesNotGuessIndicesOfUnknownExtensions) {
  EditedAsset before = small_asset();
  before.json["materials"][0]["extensions"] = {{"ACME_link", {{"node", 1}}}};
  EXPECT_THAT(changes_between(before, before).unproven, IsEmpty());
  const CompareReport report = changes_between(before, renumbered(before));
  EXPECT_THAT(report.unproven, SizeIs(1)) << words(report);
  EXPECT_FALSE(report.is_within(CompareLevel::differs));
}

// Of each fixture, also of broken ones: a text with other white space means the same.
TEST(Compare, OfAnAssetWrittenAgainIsStorage) {
  for (const char* folder : {"good", "bad", "legacy"}) {
    for (const auto& path : test::assets_in(kCompared / folder)) {
      auto container = container::open_file(path);
      ASSERT_TRUE(container) << path;
      if (!container->json) continue;
      const model::OpenedAsset opened(path, *std::move(container),
                                      container::Resolver(path.parent_path(), path.parent_path()));
      const json::Document& document = opened.document();
      if (document.empty() || !document.is_object(document.root())) continue;
      container::Container spaced = opened.container();
      spaced.json = share_text("\n" + std::string(document.text()));
      spaced.bytes = container::Bytes::from_string(std::string(spaced.bytes.text()) + " ");
      const model::OpenedAsset again(path, std::move(spaced), opened.resolver());
      CompareReport report;
      compare_assets(opened, again, *schema::builtin_set(), {}, report);
      EXPECT_EQ(report.level, CompareLevel::storage) << path << " " << words(report);
      EXPECT_THAT(report.changes, IsEmpty()) << path;
    }
  }
}

}  // namespace
}  // namespace gltfx::prove
