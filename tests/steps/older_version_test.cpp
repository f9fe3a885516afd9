// SPDX-License-Identifier: Apache-2.0
// An asset of glTF 2.1 becomes one of glTF 2.0.
#include <gmock/gmock.h>

#include "made_asset.hpp"

namespace gltfx {
namespace {

using container::test::content_of;
using container::test::TempFolder;
using test::MadeAsset;
using test::OrderedJson;
using test::StoredAsset;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Lowered {
  ConvertReport report;
  std::string text;  ///< of the new asset; empty: none was written
  std::string bin;
  OrderedJson json() const { return OrderedJson::parse(text); }
  std::vector<std::string> losses() const {
    std::vector<std::string> names;
    for (const ConvertLoss& loss : report.steps.at(0).losses) names.push_back(loss.quantity);
    return names;
  }
};

Lowered lowered(const std::string& content) {
  const TempFolder folder;
  const bool is_glb = content.starts_with("glTF");
  const auto path = folder.write(is_glb ? "a.glb" : "a.gltf", content);
  const auto output = folder.path() / (is_glb ? "out.glb" : "out.gltf");
  ConvertOptions options = test::options_to(output);
  options.later.gltf = "2.0";
  Lowered result;
  result.report = convert_file(path.native(), options);
  if (!result.report.written) return result;
  const StoredAsset stored = StoredAsset::at(output);
  result.text = stored.text;
  result.bin = stored.bin;
  return result;
}

TEST(OlderVersion, ChangesNothingButTheVersion) {
  const std::string text = R"({ "asset" : { "version":"2.1","minVersion" :"2.1" },
 "nodes": [ {"name":"é"} ],  "scenes":[{"nodes":[0]},{"nodes":[ 0]}] })";
  EXPECT_EQ(lowered(text).text, R"({ "asset" : { "version":"2.0" },
 "nodes": [ {"name":"é"} ],  "scenes":[{"nodes":[0]},{"nodes":[ 0]}] })");
  const std::string old = R"({"asset":{"version":"2.0","minVersion":"2.0"}})";
  EXPECT_EQ(lowered(old).text, old);
}

TEST(OlderVersion, PutsTheThumbnailIntoExtras) {
  const std::string images =
      R"(,"images":[{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg=="}]})";
  const Lowered plain = lowered(R"({"asset":{"version":"2.1","thumbnail":0})" + images);
  EXPECT_EQ(plain.text, R"({"asset":{"version":"2.0","extras":{"thumbnail":0}})" + images);
  EXPECT_THAT(plain.losses(), IsEmpty());
  EXPECT_THAT(plain.report.steps[0].left, IsEmpty());
  const Lowered beside =
      lowered(R"({"asset":{"version":"2.1","thumbnail":0,"extras":{"a":1}})" + images);
  EXPECT_EQ(beside.text, R"({"asset":{"version":"2.0","extras":{"a":1,"thumbnail":0}})" + images);
  const Lowered taken = lowered(R"({"asset":{"version":"2.1","thumbnail":0,"extras":[]})" + images);
  EXPECT_THAT(taken.losses(), ElementsAre("asset.thumbnail"));
}

TEST(OlderVersion, DropsWhatHasNoEffectOnThePicture) {
  const Lowered result = lowered(R"({"asset":{"version":"2.1"},
"files":[{"uri":"data:text/plain,a","mimeType":"text/plain"}],
"shapes":[{"type":"box"},{"type":"sphere"}],
"nodes":[{"boundingVolume":{"shape":0},"name":"a"},{"boundingVolume":{"shape":1}}]})");
  EXPECT_EQ(result.json().dump(), R"({"asset":{"version":"2.0"},"nodes":[{"name":"a"},{}]})");
  EXPECT_THAT(result.losses(),
              ElementsAre("boundingVolume (2 objects)", "files (1 object)", "shapes (2 objects)"));
}

TEST(OlderVersion, DoesNotShowExternalAssets) {
  const Lowered result = lowered(R"({"asset":{"version":"2.1"},
"files":[{"uri":"b.gltf","mimeType":"model/gltf+json"}],"externalAssets":[{"file":0}],
"nodes":[{"externalAsset":0}]})");
  EXPECT_EQ(result.report.error,
            "/nodes/0/externalAsset shows another asset, which --flatten copies");
}

MadeAsset made(const std::string& attribute) {
  MadeAsset asset;
  asset.json["asset"]["version"] = "2.1";
  const auto position = asset.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", true);
  OrderedJson primitive = {{"attributes", {{"POSITION", position}}}};
  if (!attribute.empty()) {
    primitive["attributes"][attribute] = asset.accessor<float>({1, 2, 3}, "SCALAR");
  }
  asset.mesh(primitive);
  return asset;
}

TEST(OlderVersion, NamesOwnAttributesWithAnUnderscore) {
  const Lowered result = lowered(made("TEMPERATURE").glb());
  EXPECT_EQ(result.json()["meshes"][0]["primitives"][0]["attributes"].dump(),
            R"({"POSITION":0,"_TEMPERATURE":1})");
  EXPECT_THAT(result.losses(),
              ElementsAre("the names of 1 attribute, which begin with an underscore now"));
  MadeAsset both = made("TEMPERATURE");
  both.json["meshes"][0]["primitives"][0]["attributes"]["_TEMPERATURE"] = 1;
  EXPECT_THAT(lowered(both.glb()).report.error, HasSubstr("has _TEMPERATURE as well"));
}

TEST(OlderVersion, StoresIntegersOfAttributesAsFloats) {
  MadeAsset asset = made("");
  const auto index = asset.accessor<std::uint32_t>({7, 1U << 24U, 0}, "SCALAR", true);
  asset.json["meshes"][0]["primitives"][0]["attributes"]["_ID"] = index;
  const Lowered result = lowered(asset.glb());
  ASSERT_TRUE(result.report.written) << result.report.error;
  const OrderedJson json = result.json();
  const auto& accessor = json["accessors"][index];
  EXPECT_EQ(accessor["componentType"], 5126);
  EXPECT_EQ(accessor["max"].dump(), "[16777216]");
  const auto& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  std::vector<float> values(3);
  std::memcpy(values.data(), result.bin.data() + view.value("byteOffset", std::size_t{0}), 12);
  EXPECT_THAT(values, ElementsAre(7.0F, 16777216.0F, 0.0F));

  MadeAsset large = made("");
  large.json["meshes"][0]["primitives"][0]["attributes"]["_ID"] =
      large.accessor<std::uint32_t>({7, (1U << 24U) + 1, 0}, "SCALAR");
  EXPECT_THAT(lowered(large.glb()).report.error,
              HasSubstr("has integers above 16777216, which floats cannot hold"));
}

TEST(OlderVersion, GivesPrimitivesTargetsWithoutEffect) {
  MadeAsset asset = made("");
  const auto moved = asset.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", true);
  OrderedJson primitive = asset.json["meshes"][0]["primitives"][0];
  primitive["targets"] = {{{"POSITION", moved}}, {{"POSITION", moved}}};
  asset.json["meshes"][0]["primitives"].push_back(primitive);
  const Lowered result = lowered(asset.glb());
  ASSERT_TRUE(result.report.written) << result.report.error;
  const OrderedJson json = result.json();
  EXPECT_EQ(json["meshes"][0]["primitives"][0]["targets"].dump(),
            R"([{"POSITION":2},{"POSITION":2}])");
  EXPECT_EQ(json["accessors"][2].dump(),
            R"({"componentType":5126,"count":3,"max":[0,0,0],"min":[0,0,0],"type":"VEC3"})");
}

MadeAsset animated(const std::string& matrix) {
  MadeAsset asset = made("");
  const auto moved = asset.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", true);
  asset.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", moved}}};
  const auto times = asset.accessor<float>({0, 1}, "SCALAR", true);
  const auto weights = asset.accessor<float>({0, 1}, "SCALAR");
  asset.json["animations"] = {
      {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
       {"samplers", {{{"input", times}, {"output", weights}}}}}};
  asset.json["nodes"][0]["matrix"] = OrderedJson::parse(matrix);
  return asset;
}

TEST(OlderVersion, SplitsMatricesOfAnimatedWeights) {
  const Lowered result = lowered(animated("[0,2,0,0,-2,0,0,0,0,0,-3,0,5,6,7,1]").glb());
  ASSERT_TRUE(result.report.written) << result.report.error;
  const OrderedJson json = result.json();
  const auto& node = json["nodes"][0];
  EXPECT_FALSE(node.contains("matrix"));
  EXPECT_EQ(node["translation"].dump(), "[5,6,7]");
  EXPECT_EQ(node["scale"].dump(), "[-2,2,3]");
  EXPECT_NEAR(node["rotation"][0].get<double>() * node["rotation"][0].get<double>() +
                  node["rotation"][1].get<double>() * node["rotation"][1].get<double>(),
              1, 1e-6);
  EXPECT_THAT(lowered(animated("[1,0,0,0,1,1,0,0,0,0,1,0,0,0,0,1]").glb()).report.error,
              HasSubstr("has a matrix that is no translation, rotation and scale"));
}

}  // namespace
}  // namespace gltfx
