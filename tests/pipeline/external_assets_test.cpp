// SPDX-License-Identifier: Apache-2.0
// External assets of glTF 2.1 are drawn at their nodes, as if they were a part of the asset.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "pipeline/baking.hpp"

namespace gltfx::test {
namespace {

using render::cube;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Json kTurned{{"translation", {0.6, 0.1, 0.2}},
                   {"rotation", {0, 0.3826834, 0, 0.9238795}},
                   {"scale", {0.5, 1.5, 0.75}}};
const Json kBeside{{"translation", {-0.7, -0.1, 0}}};

class DrawnExternalAssets : public Baking {
 protected:
  DrawnExternalAssets() {
    options.cameras = {""};
    options.sizes = {{32, 32}};
    options.samples = 4;
  }

  // A cube with a small one on it, which is a light, too.
  static Json add_child(AssetText& asset) {
    const int large = asset.mesh(cube(0.3F), asset.material(plastic()));
    const int small = asset.mesh(cube(0.1F), asset.material(dielectric({0.1, 0.3, 0.8, 1}, 0.5)));
    asset.uses("KHR_lights_punctual");
    asset.json()["extensions"]["KHR_lights_punctual"]["lights"] =
        Json::array({{{"type", "point"}, {"intensity", 5}}});
    const Json light{{"KHR_lights_punctual", {{"light", 0}}}};
    return Json::array(
        {asset.add("nodes", {{"mesh", large}}),
         asset.add("nodes", {{"mesh", small}, {"translation", {0, 0.4, 0}}}),
         asset.add("nodes", {{"translation", {0, 0.2, 0.5}}, {"extensions", light}})});
  }

  static AssetText child() {
    AssetText asset;
    const Json nodes = add_child(asset);
    asset.json()["scenes"][0]["nodes"] = nodes;
    return asset;
  }

  // Of an asset with files; each node shows the external asset of its place in the list.
  static AssetText parent(const std::vector<Json>& files,
                          const std::vector<std::pair<int, Json>>& nodes) {
    AssetText asset;
    asset.json()["asset"]["version"] = "2.1";
    asset.json()["files"] = files;
    for (std::size_t i = 0; i < files.size(); ++i) {
      asset.json()["externalAssets"].push_back({{"file", i}});
    }
    for (const auto& [external, place] : nodes) {
      Json node = place;
      node["externalAsset"] = external;
      asset.node(node);
    }
    return asset;
  }
  static Json file(const std::string& uri, const std::string& type = "model/gltf+json") {
    return {{"uri", uri}, {"mimeType", type}};
  }

  BakeReport bake_text(const std::string& text) {
    return bake_file(folder.write("main.gltf", text).native(), options);
  }
  BakeReport drawn(AssetText& asset) {
    BakeReport report = bake_text(asset.text());
    EXPECT_EQ(report.problem, BakeProblem::none) << report.error;
    return report;
  }

  // The picture of both children in one asset.
  std::vector<std::uint8_t> flattened() {
    AssetText asset;
    for (const Json& place : {kTurned, kBeside}) {
      Json node = place;
      node["children"] = add_child(asset);
      asset.node(node);
    }
    const BakeReport report = drawn(asset);
    EXPECT_THAT(report.notes, IsEmpty());
    return report.pixels.bytes;
  }
  void expect_flattened(AssetText& asset) {
    const BakeReport report = drawn(asset);
    EXPECT_THAT(report.notes, IsEmpty());
    EXPECT_EQ(report.pixels.bytes, flattened());
  }
};

TEST_F(DrawnExternalAssets, TwoPlacesOfOneAssetAreDrawn) {
  folder.write("child.gltf", child().text());
  AssetText asset = parent({file("child.gltf")}, {{0, kTurned}, {0, kBeside}});
  expect_flattened(asset);
}

TEST_F(DrawnExternalAssets, ADiamondIsDrawnTwice) {
  folder.write("parts/child.gltf", child().text());
  AssetText middle = parent({file("child.gltf")}, {{0, Json::object()}});
  folder.write("parts/a.gltf", middle.text());
  folder.write("parts/b.gltf", middle.text());
  AssetText asset =
      parent({file("parts/a.gltf"), file("parts/b.gltf")}, {{0, kTurned}, {1, kBeside}});
  expect_flattened(asset);
}

TEST_F(DrawnExternalAssets, AnAssetInABufferViewOrADataUriIsDrawn) {
  const std::string text = child().text();
  AssetText asset = parent({file("data:model/gltf+json;base64," + base64(text))}, {{0, kTurned}});
  const int view = asset.add_view(text);
  asset.json()["files"].push_back({{"bufferView", view}, {"mimeType", "model/gltf+json"}});
  asset.json()["externalAssets"].push_back({{"file", 1}});
  Json node = kBeside;
  node["externalAsset"] = 1;
  asset.node(node);
  expect_flattened(asset);
}

TEST_F(DrawnExternalAssets, ABufferComesFromAnAlias) {
  AssetText from = child();
  Json text = Json::parse(from.text());
  const std::string uri = text["buffers"][0]["uri"];
  text["buffers"][0]["uri"] = "elsewhere.bin";
  folder.write("child.gltf", text.dump());
  AssetText asset = parent({file("child.gltf")}, {{0, kTurned}, {0, kBeside}});
  asset.json()["files"].push_back(file(uri, "application/gltf-buffer"));
  asset.json()["files"][0]["aliases"] = Json::array({{{"alias", "elsewhere.bin"}, {"file", 1}}});
  expect_flattened(asset);
}

TEST_F(DrawnExternalAssets, HiddenNodesHideThemAndCyclesAreCut) {
  AssetText cyclic = child();
  cyclic.json()["asset"]["version"] = "2.1";
  cyclic.json()["files"] = Json::array({file("main.gltf")});
  cyclic.json()["externalAssets"] = Json::array({{{"file", 0}}});
  cyclic.node({{"externalAsset", 0}});
  folder.write("child.gltf", cyclic.text());
  Json hidden = kBeside;
  hidden["extensions"]["KHR_node_visibility"]["visible"] = false;
  AssetText asset = parent({file("child.gltf"), file("missing.gltf")},
                           {{0, kTurned}, {1, hidden}, {0, hidden}, {0, kBeside}});
  asset.uses("KHR_node_visibility");
  const BakeReport report = drawn(asset);
  EXPECT_EQ(report.pixels.bytes, flattened());
  EXPECT_THAT(report.notes, Contains(HasSubstr("is among its own external assets")));
  EXPECT_THAT(report.notes, Not(Contains(HasSubstr("missing.gltf"))));
}

TEST_F(DrawnExternalAssets, WhatIsMissingIsSaidAndTheRestDrawn) {
  folder.write("child.gltf", child().text());
  folder.write("not.gltf", "[]");
  AssetText asset = parent({file("child.gltf"), file("gone.gltf"), file("not.gltf")},
                           {{0, kTurned}, {1, {}}, {2, {}}, {0, kBeside}});
  const BakeReport report = drawn(asset);
  EXPECT_EQ(report.pixels.bytes, flattened());
  EXPECT_THAT(report.notes, Contains(HasSubstr("External asset 1 cannot be read: ")));
  EXPECT_THAT(report.notes, Contains(HasSubstr("External asset 2 cannot be drawn: ")));
  options.strict = true;
  EXPECT_EQ(bake_text(asset.text()).problem, BakeProblem::invalid);
}

TEST_F(DrawnExternalAssets, WithoutADefaultSceneNothingIsAdded) {
  AssetText library = child();
  library.json().erase("scene");
  folder.write("child.gltf", library.text());
  AssetText asset = parent({file("child.gltf")}, {{0, {}}});
  EXPECT_EQ(bake_text(asset.text()).problem, BakeProblem::nothing_to_see);
}

TEST_F(DrawnExternalAssets, VariantsAndFramedNodesAreChosenByName) {
  AssetText colored = child();
  colored.uses("KHR_materials_variants");
  colored.json()["extensions"]["KHR_materials_variants"]["variants"] =
      Json::array({{{"name", "blue"}}});
  colored.json()["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] =
      Json::array({{{"material", 1}, {"variants", Json::array({0})}}});
  folder.write("child.gltf", colored.text());
  Json named = kTurned;
  named["name"] = "right";
  AssetText asset = parent({file("child.gltf")}, {{0, named}, {0, kBeside}});
  const auto plain = drawn(asset).pixels.bytes;
  options.variant = "blue";
  const auto blue = drawn(asset).pixels.bytes;
  EXPECT_NE(blue, plain);
  options.frame = "right";
  EXPECT_NE(drawn(asset).pixels.bytes, blue);
  options.variant = "red";
  EXPECT_EQ(bake_text(asset.text()).problem, BakeProblem::refused);
}

// Few small files that ask for a billion places.
TEST_F(DrawnExternalAssets, PlacesAreBounded) {
  folder.write("9.gltf", child().text());
  for (int level = 8; level >= 0; --level) {
    const std::vector<std::pair<int, Json>> nodes(10, {0, {{"translation", {0.01, 0, 0}}}});
    AssetText asset = parent({file(fmt::format("{}.gltf", level + 1))}, nodes);
    folder.write(fmt::format("{}.gltf", level), asset.text());
  }
  options.sizes = {{4, 4}};
  options.quality = BakeQuality::draft;
  AssetText asset = parent({file("6.gltf")}, {{0, {}}});
  EXPECT_THAT(drawn(asset).notes, IsEmpty());
  AssetText all = parent({file("0.gltf")}, {{0, {}}});
  EXPECT_THAT(bake_text(all.text()).notes, Contains(HasSubstr("too many external assets")));
}

}  // namespace
}  // namespace gltfx::test
