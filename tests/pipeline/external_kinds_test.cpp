// SPDX-License-Identifier: Apache-2.0
// What external assets of glTF 2.1 may contain is drawn as in an asset that has it itself.
#include <filesystem>
#include <functional>

#include <gmock/gmock.h>

#include "container/glb3_builder.hpp"
#include "pipeline/baking.hpp"

namespace gltfx::test {
namespace {

using container::kChunkBin;
using container::kChunkJson;
using container::test::chunk;
using container::test::glb;
using container::test::glb3;
using render::cube;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

const Json kUpper{{"translation", {0.6, 0.1, 0.2}},
                  {"rotation", {0, 0.3826834, 0, 0.9238795}},
                  {"scale", {0.5, 1.5, 0.75}}};
const Json kLower{{"translation", {-0.7, -0.1, 0}}, {"rotation", {0, 0, 0.3826834, 0.9238795}}};

/// Adds objects to an asset. The roots of what it shows.
using FillChild = std::function<Json(AssetText&)>;

class KindsOfExternalAssets : public Baking {
 protected:
  KindsOfExternalAssets() {
    options.cameras = {""};
    options.sizes = {{32, 32}};
    options.samples = 4;
  }

  static Json file(const std::string& uri, const std::string& type = "model/gltf+json") {
    return {{"uri", uri}, {"mimeType", type}};
  }
  static std::string child_of(const FillChild& fill) {
    AssetText asset;
    const Json roots = fill(asset);
    asset.json()["scenes"][0]["nodes"] = roots;
    return asset.text();
  }
  /// An asset that shows its first file there.
  static AssetText parent(const Json& files, const Json& place) {
    AssetText asset;
    asset.json()["asset"]["version"] = "2.1";
    asset.json()["files"] = files;
    asset.json()["externalAssets"] = Json::array({{{"file", 0}}});
    Json node = place;
    node["externalAsset"] = 0;
    asset.node(node);
    return asset;
  }
  BakeReport bake_at(const std::string& path) {
    BakeReport report = bake_file((folder.path() / path).native(), options);
    EXPECT_EQ(report.problem, BakeProblem::none) << report.error << first_error(report);
    return report;
  }
  /// The picture of what would be the child, in one asset.
  std::vector<std::uint8_t> flattened(const FillChild& fill, const std::vector<Json>& places) {
    AssetText asset;
    Json nodes = fill(asset);
    for (auto place = places.rbegin(); place != places.rend(); ++place) {
      Json node = *place;
      node["children"] = nodes;
      nodes = Json::array({asset.add("nodes", node)});
    }
    asset.json()["scenes"][0]["nodes"] = nodes;
    folder.write("flat.gltf", asset.text());
    return bake_at("flat.gltf").pixels.bytes;
  }
  void expect_flattened(const std::string& path, const FillChild& fill,
                        const std::vector<Json>& places = {kUpper}) {
    const BakeReport report = bake_at(path);
    EXPECT_THAT(report.notes, IsEmpty()) << first_error(report);
    EXPECT_EQ(report.pixels.bytes, flattened(fill, places));
  }
};

std::string padded(std::string text, char with) {
  text.resize((text.size() + 3) / 4 * 4, with);
  return text;
}

Json plain_cube(AssetText& asset) {
  return Json::array(
      {asset.add("nodes", {{"mesh", asset.mesh(cube(0.3F), asset.material(plastic()))}})});
}

// A cube whose upper half turns with the second joint.
Json skinned_cube(AssetText& asset) {
  const render::Mesh shape = cube(0.4F);
  const int mesh = asset.mesh(shape, asset.material(plastic()));
  std::string joints;
  std::vector<float> weights;
  for (const auto& point : shape.positions) {
    joints += std::string({static_cast<char>(point[1] > 0 ? 1 : 0), 0, 0, 0});
    weights.insert(weights.end(), {1, 0, 0, 0});
  }
  Json& attributes =
      asset.json()["meshes"][static_cast<std::size_t>(mesh)]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = asset.accessor("VEC4", 5121, shape.positions.size(), joints);
  attributes["WEIGHTS_0"] = asset.accessor("VEC4", 5126, shape.positions.size(), packed(weights));
  const int tip = asset.add(
      "nodes", {{"rotation", {0, 0.3826834, 0, 0.9238795}}, {"translation", {0.2, 0.3, 0}}});
  const int root = asset.add("nodes", {{"children", Json::array({tip})}});
  asset.add("skins", {{"joints", Json::array({root, tip})}});
  const int drawn = asset.add("nodes", {{"mesh", mesh}, {"skin", 0}});
  return Json::array({root, drawn});
}

// Beside one at rest, so that no camera follows it.
Json moving_cube(AssetText& asset) {
  Json nodes = plain_cube(asset);
  nodes.push_back(plain_cube(asset)[0]);
  const int times = asset.accessor("SCALAR", 5126, 2, packed(std::vector<float>{0, 1}),
                                   {{"min", {0}}, {"max", {1}}});
  const int places =
      asset.accessor("VEC3", 5126, 2, packed(std::vector<float>{0, 0, 0, 0.4F, 0.6F, 0}));
  Json animation{{"name", "rise"}};
  animation["samplers"] = Json::array({{{"input", times}, {"output", places}}});
  animation["channels"] =
      Json::array({{{"sampler", 0}, {"target", {{"node", nodes[0]}, {"path", "translation"}}}}});
  asset.add("animations", animation);
  return nodes;
}

// With a texture in the file of that name.
FillChild textured_ball(const std::string& uri) {
  return [uri](AssetText& asset) {
    const render::Mesh shape = render::sphere(0.4F, 6);
    asset.add("images", {{"uri", uri}});
    asset.add("textures", {{"source", 0}});
    Json material = plastic();
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    return Json::array(
        {asset.add("nodes", {{"mesh", asset.mesh(shape, asset.material(material))}})});
  };
}

TEST_F(KindsOfExternalAssets, ATextureComesFromAnAlias) {
  std::filesystem::copy_file(std::string(GLTFX_SOURCE_DIR) + "/fixtures/materials/metallic.png",
                             folder.path() / "blue.png");
  folder.write("child.gltf", child_of(textured_ball("paint.png")));
  Json child = file("child.gltf");
  child["aliases"] = Json::array({{{"alias", "paint.png"}, {"file", 1}}});
  folder.write("main.gltf",
               parent(Json::array({child, file("blue.png", "image/png")}), kUpper).text());
  expect_flattened("main.gltf", textured_ball("blue.png"));
}

TEST_F(KindsOfExternalAssets, SkinsFollowTheirJoints) {
  folder.write("child.gltf", child_of(skinned_cube));
  folder.write("main.gltf", parent(Json::array({file("child.gltf")}), kUpper).text());
  expect_flattened("main.gltf", skinned_cube);
}

TEST_F(KindsOfExternalAssets, AnimationsAreChosenByNameAndTime) {
  folder.write("child.gltf", child_of(moving_cube));
  folder.write("main.gltf", parent(Json::array({file("child.gltf")}), kUpper).text());
  const auto at_rest = bake_at("main.gltf").pixels.bytes;
  options.animation = "rise";
  options.time = 0.75;
  expect_flattened("main.gltf", moving_cube);
  EXPECT_NE(bake_at("main.gltf").pixels.bytes, at_rest);
}

TEST_F(KindsOfExternalAssets, TransformsOfAllLevelsApply) {
  folder.write("parts/deep/child.gltf", child_of(plain_cube));
  folder.write("parts/middle.gltf", parent(Json::array({file("deep/child.gltf")}), kLower).text());
  folder.write("main.gltf", parent(Json::array({file("parts/middle.gltf")}), kUpper).text());
  expect_flattened("main.gltf", plain_cube, {kUpper, kLower});
}

TEST_F(KindsOfExternalAssets, AssetsInChunksAreDrawn) {
  for (const std::uint32_t version : {2U, 3U}) {
    const std::string child = child_of(plain_cube);
    AssetText main =
        parent(Json::array({{{"bufferView", 0}, {"mimeType", "model/gltf+json"}}}), kUpper);
    main.json()["buffers"] = Json::array({{{"byteLength", child.size()}}});
    main.json()["bufferViews"] = Json::array({{{"buffer", 0}, {"byteLength", child.size()}}});
    const std::string text = main.json().dump();
    folder.write("main.glb", version == 2 ? glb(chunk(kChunkJson, padded(text, ' ')) +
                                                chunk(kChunkBin, padded(child, '\0')))
                                          : glb3({{kChunkJson, text}, {kChunkBin, child}}));
    expect_flattened("main.glb", plain_cube);
  }
}

TEST_F(KindsOfExternalAssets, FilesOutsideOfTheRootAreNotDrawn) {
  folder.write("child.gltf", child_of(plain_cube));
  AssetText main = parent(Json::array({file("../child.gltf")}), kUpper);
  const Json own = plain_cube(main);
  main.json()["scenes"][0]["nodes"].push_back(own[0]);
  folder.write("inside/main.gltf", main.text());
  const BakeReport report = bake_at("inside/main.gltf");
  EXPECT_THAT(report.notes, Contains(HasSubstr("External asset 0 cannot be read: ")));
  EXPECT_EQ(report.pixels.bytes, flattened(plain_cube, {}));
  options.root = folder.path().native();
  EXPECT_NE(bake_at("inside/main.gltf").pixels.bytes, report.pixels.bytes);
}

}  // namespace
}  // namespace gltfx::test
