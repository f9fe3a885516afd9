// SPDX-License-Identifier: Apache-2.0
// An asset of glTF 2.1 becomes one of glTF 2.0.
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "container/glb3_builder.hpp"
#include "made_asset.hpp"

namespace gltfx {
namespace {

using container::kChunkBin;
using container::kChunkJson;
using container::test::content_of;
using container::test::glb3;
using container::test::TempFolder;
using test::MadeAsset;
using test::OrderedJson;
using test::StoredAsset;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

struct Lowered {
  ConvertReport report;
  std::string text;  ///< of the new asset; empty: none was written
  std::string bin;
  std::optional<std::uint32_t> glb_version;
  std::map<std::string, std::string> files;  ///< all others of its folder
  OrderedJson json() const { return OrderedJson::parse(text); }
  std::vector<std::string> losses() const {
    std::vector<std::string> names;
    for (const ConvertLoss& loss : report.steps.at(0).losses) names.push_back(loss.quantity);
    return names;
  }
};

/// `ask` changes the options.
Lowered lowered(
    const std::string& content,
    const std::function<void(ConvertOptions&)>& ask = [](ConvertOptions&) {}) {
  const TempFolder folder;
  std::filesystem::create_directory(folder.path() / "out");
  const bool is_glb = content.starts_with("glTF");
  const auto path = folder.write(is_glb ? "a.glb" : "a.gltf", content);
  ConvertOptions options = test::options_to(folder.path() / "out" / path.filename());
  options.later.gltf = "2.0";
  ask(options);
  Lowered result;
  result.report = convert_file(path.native(), options);
  if (!result.report.written) return result;
  const std::filesystem::path output = options.in_place ? path.native() : options.output;
  const StoredAsset stored = StoredAsset::at(output);
  result.text = stored.text;
  result.bin = stored.bin;
  result.glb_version = stored.container.glb_version;
  for (const auto& entry : std::filesystem::directory_iterator(output.parent_path())) {
    if (entry.path() != output && entry.is_regular_file()) {
      result.files[entry.path().filename().native()] = content_of(entry.path());
    }
  }
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

constexpr std::string_view kViews =
    R"("bufferViews":[{"buffer":0,"byteLength":5},{"buffer":1,"byteOffset":1,"byteLength":3}])";

std::string in_two_chunks() {
  const std::string text =
      fmt::format(R"({{"asset":{{"version":"2.1","minVersion":"2.1"}},"buffers":[
{{"byteLength":5,"chunk":1}},{{"byteLength":4,"chunk":2}}],{}}})",
                  kViews);
  return glb3({{kChunkJson, text}, {kChunkBin, "abcde"}, {kChunkBin, "1234"}});
}

void expect_joined(const Lowered& result) {
  ASSERT_TRUE(result.report.written) << result.report.error;
  EXPECT_EQ(result.glb_version, 2U);
  EXPECT_EQ(result.bin, std::string("abcde\0\0\0", 8) + "1234");
  EXPECT_EQ(result.text, R"({"asset":{"version":"2.0"},"buffers":[
{"byteLength":12}],"bufferViews":[{"buffer":0,"byteLength":5},{"buffer":0,"byteOffset":9,"byteLength":3}]})");
}

TEST(OlderVersion, JoinsTheChunksOfBuffers) {
  const Lowered result =
      lowered(in_two_chunks(), [](ConvertOptions& options) { options.verify = true; });
  expect_joined(result);
  EXPECT_THAT(result.losses(), IsEmpty());
  ASSERT_EQ(result.report.steps.size(), 2U);
  EXPECT_EQ(result.report.steps[1].what, "GLB version 3 -> 2, 2 BIN chunks joined");
}

TEST(OlderVersion, JoinsChunksInPlace) {
  expect_joined(lowered(in_two_chunks(), [](ConvertOptions& options) {
    options.output.clear();
    options.in_place = true;
  }));
}

TEST(OlderVersion, JoinsChunksWhoseElementsChange) {
  const std::string text = R"({"asset":{"version":"2.1"},"buffers":[
{"byteLength":36,"chunk":1},{"byteLength":12,"chunk":2}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":1,"byteLength":12}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[0,0,0]},
{"bufferView":1,"componentType":5125,"count":3,"type":"SCALAR"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"_ID":1}}]}],"nodes":[{"mesh":0}]})";
  const std::string ids("\7\0\0\0\1\0\0\0\2\0\0\0", 12);
  const Lowered result =
      lowered(glb3({{kChunkJson, text}, {kChunkBin, std::string(36, '\0')}, {kChunkBin, ids}}));
  ASSERT_TRUE(result.report.written) << result.report.error;
  const OrderedJson json = result.json();
  EXPECT_EQ(json["asset"].dump(), R"({"version":"2.0"})");
  EXPECT_EQ(json["buffers"].dump(), R"([{"byteLength":52}])");  // 36, 4, 12
  EXPECT_EQ(json["accessors"][1]["componentType"], 5126);
  const auto& view = json["bufferViews"][json["accessors"][1]["bufferView"].get<std::size_t>()];
  std::vector<float> values(3);
  std::memcpy(values.data(), result.bin.data() + view.value("byteOffset", std::size_t{0}), 12);
  EXPECT_THAT(values, ElementsAre(7.0F, 1.0F, 2.0F));
}

TEST(OlderVersion, MakesFilesOrDataOfChunks) {
  const Lowered text = lowered(in_two_chunks(), [](ConvertOptions& options) {
    options.to = StoredAs::gltf;
    options.output = std::filesystem::path(options.output).replace_extension(".gltf").native();
  });
  ASSERT_TRUE(text.report.written) << text.report.error;
  EXPECT_EQ(text.text, fmt::format(R"({{"asset":{{"version":"2.0"}},"buffers":[
{{"byteLength":5,"uri":"a.bin"}},{{"byteLength":4,"uri":"a-1.bin"}}],{}}})",
                                   kViews));
  EXPECT_THAT(text.files, ElementsAre(Pair("a-1.bin", "1234"), Pair("a.bin", "abcde")));
  const Lowered embedded = lowered(in_two_chunks(), [](ConvertOptions& options) {
    options.to = StoredAs::embedded;
    options.output = std::filesystem::path(options.output).replace_extension(".gltf").native();
  });
  ASSERT_TRUE(embedded.report.written) << embedded.report.error;
  EXPECT_EQ(embedded.json()["asset"].dump(), R"({"version":"2.0"})");
  EXPECT_EQ(embedded.json()["buffers"][1].dump(),
            R"({"byteLength":4,"uri":"data:application/octet-stream;base64,MTIzNA=="})");
}

TEST(OlderVersion, GivesAGlbVersionTwo) {
  const auto with_version = [](std::string_view version) {
    return glb3({{kChunkJson, fmt::format(R"({{"asset":{{"version":"{}"}},"buffers":[
{{"byteLength":4}}]}})",
                                          version)},
                 {kChunkBin, "abcd"}});
  };
  const auto in_place = [](ConvertOptions& options) {
    options.output.clear();
    options.in_place = true;
  };
  for (const char* version : {"2.1", "2.0"}) {
    const Lowered result = lowered(with_version(version), in_place);
    EXPECT_EQ(result.glb_version, 2U) << version << result.report.error;
    EXPECT_EQ(result.bin, "abcd");
  }
  const Lowered kept = lowered(with_version("2.1"), [](ConvertOptions& options) {
    options.later.glb_version = GlbVersion::three;
  });
  EXPECT_EQ(kept.glb_version, 3U) << kept.report.error;
  EXPECT_EQ(kept.json()["asset"].dump(), R"({"version":"2.0"})");
}

TEST(OlderVersion, RefusesToKeepChunksApart) {
  const Lowered result = lowered(in_two_chunks(), [](ConvertOptions& options) {
    options.later.glb_version = GlbVersion::three;
  });
  EXPECT_EQ(result.report.error, "buffers of glTF 2.0 have no `chunk`; use --glb 2 or --to gltf");
}

TEST(OlderVersion, JoinsBuffersOfOneChunkOfVersionTwo) {
  const Lowered result = lowered(test::glb_of(R"({"asset":{"version":"2.1"},"buffers":[
{"byteLength":4,"uri":"data:application/octet-stream;base64,MTIzNA=="},
{"byteLength":8,"chunk":1},{"byteLength":3,"chunk":1}],
"bufferViews":[{"buffer":0,"byteLength":4},{"buffer":1,"byteLength":8},{"buffer":2,"byteLength":3}]})",
                                              "abcdefgh"));
  ASSERT_TRUE(result.report.written) << result.report.error;
  EXPECT_EQ(result.bin, std::string("1234\0\0\0\0", 8) + "abcdefgh");
  EXPECT_EQ(result.json()["buffers"].dump(), R"([{"byteLength":16}])");
  EXPECT_EQ(result.json()["bufferViews"].dump(),
            R"([{"buffer":0,"byteLength":4},{"buffer":0,"byteLength":8,"byteOffset":8},)"
            R"({"buffer":0,"byteLength":3,"byteOffset":8}])");
}

TEST(OlderVersion, DropsNumbersOfChunksBesideFiles) {
  const Lowered result = lowered(R"({"asset":{"version":"2.1"},"buffers":[
{"byteLength":4,"uri":"data:application/octet-stream;base64,MTIzNA==","chunk":7}]})");
  EXPECT_EQ(result.text, R"({"asset":{"version":"2.0"},"buffers":[
{"byteLength":4,"uri":"data:application/octet-stream;base64,MTIzNA=="}]})");
}

TEST(OlderVersion, RefusesNumbersOfMissingChunks) {
  const Lowered result = lowered(test::glb_of(
      R"({"asset":{"version":"2.1"},"buffers":[{"byteLength":4,"chunk":7}]})", "abcd"));
  EXPECT_EQ(result.report.error, "/buffers/0/chunk is not the number of a BIN chunk");
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
