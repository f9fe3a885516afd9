// SPDX-License-Identifier: Apache-2.0
/// Fixtures that are stored otherwise: renumbered, shared, packed. They mean the same.
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "graph/graph.hpp"
#include "prove/edited_asset.hpp"

namespace gltfx::prove {
namespace {

using test::EditedAsset;
using test::Json;

const std::filesystem::path kAssets = std::filesystem::path(GLTFX_SOURCE_DIR) / "fixtures/good";

/// Renumbers elements of lists, and all references to them according to the schemas.
class Renumbering {
 public:
  explicit Renumbering(const EditedAsset& asset) : asset_(asset), opened_(asset.open()) {}

  // The first element becomes the last one, and so on; JSON pointers follow.
  EditedAsset reversed() const {
    const graph::Graph graph(opened_.document(), *schema::builtin_set());
    EditedAsset result = asset_;
    std::map<std::string, std::size_t> sizes;
    for (const schema::TargetArray& array : graph.checked().targets) {
      const Json& list = asset_.json.at(Json::json_pointer(array.pointer));
      if (array.pointer == "/scenes" || array.pointer == "/animations") continue;
      sizes[array.pointer] = list.size();
    }
    for (const graph::IndexUse& use : graph.indices()) {
      const auto size = sizes.find(std::string(use.array));
      if (size == sizes.end() || use.index >= size->second) continue;
      result.json[Json::json_pointer(graph.tree().pointer(use.at))] = size->second - 1 - use.index;
    }
    for (const graph::PointerText& pointer : graph.pointers())
      rename(graph, pointer, sizes, result);
    // Buffer 0 of a GLB may be the BIN chunk because of its position; here all buffers have a name.
    for (const auto& [pointer, size] : sizes) {
      Json& list = result.json[Json::json_pointer(pointer)];
      std::reverse(list.begin(), list.end());
    }
    return result;
  }

 private:
  static void rename(const graph::Graph& graph, const graph::PointerText& pointer,
                     const std::map<std::string, std::size_t>& sizes, EditedAsset& result) {
    std::string path, now;
    for (std::size_t i = 0; i < pointer.steps.size(); ++i) {
      const auto size = sizes.find(path);
      const bool element = size != sizes.end() && i < pointer.way.size();
      now += "/" + (element ? std::to_string(size->second - 1 - std::stoul(pointer.steps[i]))
                            : pointer.steps[i]);
      path += "/" + pointer.steps[i];
    }
    result.json[Json::json_pointer(graph.tree().pointer(pointer.at))] = now;
  }

  const EditedAsset& asset_;
  const model::OpenedAsset opened_;
};

TEST(EqualMeaning, NumbersOfObjectsSayNothing) {
  int renumbered = 0;
  for (const auto& path : test::assets_in(kAssets)) {
    const EditedAsset before = EditedAsset::load(path);
    const EditedAsset after = Renumbering(before).reversed();
    if (before.json == after.json) continue;
    ++renumbered;
    MeaningRequest request;
    for (const bool free : {false, true}) {
      request.order = free ? VertexOrder::free : VertexOrder::kept;
      // Unused objects are identified only by their order.
      request.unused_may_go = true;
      const Meaning meaning = test::compare(before, after, request);
      EXPECT_TRUE(meaning.same()) << path << "\n" << test::text(meaning);
    }
  }
  EXPECT_GE(renumbered, 30);
}

constexpr std::string_view kTwice = R"({
  "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
  "nodes": [{"mesh": 0}, {"mesh": 1, "translation": [1, 0, 0]}],
  "materials": [{"name": "wood"}, {"name": "wood"}, {"name": "stone"}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]},
             {"primitives": [{"attributes": {"POSITION": 1}, "material": 1}]}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}]})";

EditedAsset twice() {
  const float points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  return EditedAsset::made(std::string(kTwice),
                           {reinterpret_cast<const char*>(points), sizeof(points)});
}

TEST(EqualMeaning, OneObjectMayServeForTwo) {
  const EditedAsset before = twice();
  EditedAsset after = before;
  after.json["meshes"][1]["primitives"][0]["material"] = 0;
  after.json["meshes"][1]["primitives"][0]["attributes"]["POSITION"] = 0;
  after.json["accessors"].erase(1);
  after.json["materials"].erase(1);
  EXPECT_TRUE(test::compare(before, after).same());
  EXPECT_TRUE(test::compare(after, before).same());
  after.json["materials"].erase(1);  // "stone"
  EXPECT_FALSE(test::compare(before, after).same());
  MeaningRequest pruned;
  pruned.unused_may_go = true;
  EXPECT_TRUE(test::compare(before, after, pruned).same());
  // A different one must not be removed.
  EditedAsset other = before;
  other.json["meshes"][1]["primitives"][0]["material"] = 2;
  EXPECT_FALSE(test::compare(before, other, pruned).same());
}

TEST(EqualMeaning, NamesOfImagesCountUnlessTheyMayGo) {
  EditedAsset before = twice();
  before.json["images"] = Json::parse(R"([{"uri": "a.png", "name": "a", "extras": 1}])");
  before.json["textures"] = Json::parse(R"([{"source": 0}])");
  before.json["materials"][0]["normalTexture"]["index"] = 0;
  EditedAsset after = before;
  after.json["images"][0]["name"] = "b";
  EXPECT_FALSE(test::compare(before, after).same());
  MeaningRequest renamed;
  renamed.image_names_may_go = true;
  EXPECT_TRUE(test::compare(before, after, renamed).same());
  after.json["images"][0].erase("name");
  EXPECT_TRUE(test::compare(before, after, renamed).same());
  after.json["images"][0]["extras"] = 2;
  EXPECT_FALSE(test::compare(before, after, renamed).same());
  after = before;
  after.json["materials"][0]["name"] = "b";
  EXPECT_FALSE(test::compare(before, after, renamed).same());
}

TEST(EqualMeaning, ObjectsThatAPointerTellsApartAreNotOne) {
  EditedAsset before = twice();
  before.json["extensionsUsed"] = {"KHR_animation_pointer"};
  before.json["animations"] = Json::parse(R"([{
    "samplers": [{"input": 2, "output": 2}],
    "channels": [{"sampler": 0, "target": {"path": "pointer", "extensions": {
      "KHR_animation_pointer": {"pointer": "/materials/1/alphaCutoff"}}}}]}])");
  before.json["accessors"].push_back(
      Json::parse(R"({"bufferView": 0, "componentType": 5126, "count": 2, "type": "SCALAR"})"));
  before.json["materials"][0]["alphaCutoff"] = 0.5;
  before.json["materials"][1]["alphaCutoff"] = 0.5;
  EXPECT_TRUE(test::compare(before, before).same());
  EditedAsset after = before;
  after.json["meshes"][0]["primitives"][0]["material"] = 1;
  MeaningRequest pruned;
  pruned.unused_may_go = true;
  EXPECT_FALSE(test::compare(before, after, pruned).same());
  EditedAsset elsewhere = before;
  elsewhere.json["animations"][0]["channels"][0]["target"]["extensions"]["KHR_animation_pointer"]
                ["pointer"] = "/materials/0/alphaCutoff";
  EXPECT_FALSE(test::compare(before, elsewhere, pruned).same());
}

// Four samplers whose outputs are these accessors: one that cannot be read, (0, 0) and (0, 5).
EditedAsset sampled(const std::vector<int>& outputs) {
  const float values[4] = {0, 0, 0, 5};
  EditedAsset asset = EditedAsset::made(R"({
    "asset": {"version": "2.0"}, "nodes": [{}], "animations": [{}],
    "bufferViews": [{"buffer": 0, "byteLength": 16}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 900, "type": "SCALAR"},
      {"bufferView": 0, "componentType": 5126, "count": 2, "type": "SCALAR"},
      {"bufferView": 0, "byteOffset": 8, "componentType": 5126, "count": 2, "type": "SCALAR"}]})",
                                        {reinterpret_cast<const char*>(values), sizeof(values)});
  Json& animation = asset.json["animations"][0];
  for (const int output : outputs) {
    const std::size_t sampler = animation["samplers"].size();
    animation["samplers"].push_back({{"input", 1}, {"output", output}});
    animation["channels"].push_back(
        {{"sampler", sampler}, {"target", {{"node", 0}, {"path", "weights"}}}});
  }
  return asset;
}

TEST(EqualMeaning, WhatCannotBeReadMakesNoTwoEqual) {
  EXPECT_TRUE(test::compare(sampled({0, 0, 1, 1}), sampled({1, 2, 1, 1})).same());
  EXPECT_FALSE(test::compare(sampled({0, 0, 1, 1}), sampled({1, 2, 1, 2})).same());
}

TEST(EqualMeaning, UnusedSamplersStay) {
  EditedAsset before = sampled({1, 2});
  before.json["animations"][0]["channels"].erase(1);
  EditedAsset after = before;
  EXPECT_TRUE(test::compare(before, after).same());
  after.json["animations"][0]["samplers"][1]["interpolation"] = "STEP";
  EXPECT_FALSE(test::compare(before, after).same());
  after.json["animations"][0]["samplers"].erase(1);
  EXPECT_THAT(test::text(test::compare(before, after)),
              testing::HasSubstr("/animations/0/samplers has 0 elements"));
  EXPECT_FALSE(test::compare(after, before).same());
  MeaningRequest pruned;
  pruned.unused_may_go = true;
  EXPECT_TRUE(test::compare(before, after, pruned).same());
  before.json["animations"] = Json::parse("[{}]");
  after = before;
  after.json["animations"][0]["samplers"] = Json::parse(R"([{"input": 1, "output": 1}])");
  EXPECT_FALSE(test::compare(before, after).same());
  EXPECT_FALSE(test::compare(after, before).same());
}

TEST(EqualMeaning, EqualNodesAreNotOne) {
  EditedAsset before = EditedAsset::made(R"({
    "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
    "nodes": [{"children": [1, 2]}, {}, {}], "skins": [{"joints": [1, 2]}]})");
  EditedAsset after = before;
  after.json["skins"][0]["joints"] = {2, 1};
  EXPECT_THAT(test::text(test::compare(before, after)), testing::HasSubstr("/skins/0/joints/0"));
}

TEST(EqualMeaning, BuffersAndViewsSayNothing) {
  const EditedAsset before = twice();
  EditedAsset after = before;
  after.files["buffer0.bin"].insert(0, 8, 'x');
  after.json["buffers"][0]["byteLength"] = 44;
  after.json["buffers"][0]["name"] = "moved";
  after.json["bufferViews"] = Json::parse(R"([{"buffer": 0, "byteLength": 44}])");
  for (Json& accessor : after.json["accessors"]) accessor["byteOffset"] = 8;
  EXPECT_TRUE(test::compare(before, after).same());
  after.json["accessors"][1]["byteOffset"] = 4;
  EXPECT_FALSE(test::compare(before, after).same());
}

TEST(EqualMeaning, OfWhatIsNoAsset) {
  const EditedAsset asset = twice();
  EditedAsset none;
  none.json = Json::parse("[]");
  EXPECT_TRUE(test::compare(none, asset).same());
  EXPECT_FALSE(test::compare(asset, none).same());
}

}  // namespace
}  // namespace gltfx::prove
