// SPDX-License-Identifier: Apache-2.0
/// Facts as JSON: the published schema describes what is written.
#include <gltfx/inspect.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "report/facts_json.hpp"
#include "schema_check.hpp"

namespace gltfx::report {
namespace {

using Json = nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

AssetFacts full() {
  AssetFacts facts;
  facts.mime_type = "model/gltf+json";
  facts.version = facts.min_version = "2.0";
  facts.generator = facts.copyright = "\x1b[31m##vso[x]</script>";
  facts.files = {{"", 100}, {"a.bin", 20}};
  facts.bytes[0] = 120;
  facts.extensions = {{"KHR_x", "unknown", "https://example.com", "KHR_y", true, true, true}};
  facts.bounds = SceneBounds{{-1, 0, 0}, {1, 0.5, 2}};
  facts.meshes = {{"small", 1, 2, 3, 4, 5}, {"large", 1, 2, 3, 40, 5}, {"middle", 1, 2, 3, 14, 5}};
  facts.materials = {{"m", "BLEND", true, 2, {"KHR_x"}}};
  ImageFacts image;
  image.name = image.uri = image.encoding = "i";
  image.format = "image/png";
  image.channels = "rgb";
  image.slots = {"baseColorTexture"};
  image.color_space = "sRGB";
  facts.images = {image, {}};
  facts.animations = {{"a", 1.5, 1, 2, 3, 4}};
  facts.skins = {{"s", 1, 2}};
  facts.cameras = {{"c", "perspective"}};
  facts.lights = {{"", "spot"}};
  facts.shapes = facts.bounding_volumes = 2;
  facts.referred_files = {{"f", "b.gltf", "model/gltf+json", 5, {"c.bin"}, {}},
                          {{}, {}, "text/plain", {}, {}, "it is not there"}};
  facts.external_assets = {
      {0, 0, "b.gltf", "model/gltf+json", 1, ExternalAssetState::read, 1, 2, 3, 4, {}},
      {1, 0, "a.gltf", "model/gltf+json", 1, ExternalAssetState::cycle, 0, 0, 0, 0, {}},
      {0, 1, "b.gltf", "model/gltf+json", 0, ExternalAssetState::repeated, 0, 0, 0, 0, {}},
      {0, 2, "c.gltf", {}, 0, ExternalAssetState::unread, 0, 0, 0, 0, "it is not there"}};
  facts.problems = {"It rains."};
  return facts;
}

AssetFacts bare_facts() {
  AssetFacts facts;
  facts.mime_type = "model/gltf-binary";
  return facts;
}

Json run(const std::vector<InspectReport>& reports) {
  std::string text;
  InspectWriter writer;
  writer.begin(text);
  for (const InspectReport& report : reports) writer.file(report, text);
  writer.end(text);
  EXPECT_THAT(text, Not(HasSubstr("##vso[")));
  return Json::parse(text);
}

testing::SchemaCheck published_facts_schema() {
  return testing::SchemaCheck(Json::parse(inspect_report_schema()));
}

TEST(FactsJson, IsAsThePublishedSchemaSays) {
  InspectReport whole{"a.gltf", {}, full(), {}, "no", {}, {}};
  whole.upgrade = {{"/materials/0", "KHR_a", "KHR_b", "safe", true, {"note"}}};
  const InspectReport broken{"b.gltf", "it holds no glTF", {}, {}, {}, {}, {}};
  const InspectReport bare{"c.gltf", {}, bare_facts(), {}, {}, {}, {}};
  const Json report = run({whole, broken, bare});
  EXPECT_THAT(published_facts_schema().errors(report), IsEmpty());
  EXPECT_EQ(report["assets"].size(), 3U);
  EXPECT_EQ(report["assets"][0]["facts"]["bytes"]["total"], 120);
  EXPECT_EQ(report["assets"][0]["facts"]["generator"], "\x1b[31m##vso[x]</script>");
  EXPECT_EQ(run({})["assets"].size(), 0U);
}

TEST(FactsJson, KeepsTheLargestWhereThereIsALimit) {
  std::string text;
  json::Writer writer(text);
  write_facts(writer, full(), 2);
  const auto facts = Json::parse(text);
  std::vector<std::string> names;
  for (const auto& mesh : facts["meshes"]) names.push_back(mesh["name"]);
  EXPECT_THAT(names, ElementsAre("large", "middle"));
  EXPECT_EQ(facts["counts"]["meshes"], 3);
  EXPECT_EQ(facts["externalAssets"].size(), 2U);  // from the top: they are a tree
  EXPECT_EQ(facts["externalAssets"][1]["state"], "cycle");
  EXPECT_EQ(facts["meshes"][1]["index"], 2);
}

}  // namespace
}  // namespace gltfx::report
