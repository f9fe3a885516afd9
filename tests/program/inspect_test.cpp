// SPDX-License-Identifier: Apache-2.0
// `gltfx inspect`: tables for people, JSON for programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Inspect : public testing::Test {
 protected:
  Outcome here(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "inspect");
    return gltfx(std::move(arguments), {folder_.path().native(), {}, {}});
  }
  TempFolder folder_;
};

TEST_F(Inspect, TablesTellWhatIsInAnAsset) {
  const Outcome outcome = here({fixture("good/beacon.gltf")});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("1 scene, 1 node, 1 mesh, 1 primitive, 90 triangles"),
                                 HasSubstr("Where the bytes go"), HasSubstr("animations     60"),
                                 HasSubstr("KHR_lights_punctual              ratified  used"),
                                 HasSubstr("0  Blink      0.8         3          6     60"),
                                 HasSubstr("0  Beacon  point")));
}

TEST_F(Inspect, ExtensionsWithoutObjectsAreToldByWhatTheyAllow) {
  folder_.write("a.gltf", R"({"asset": {"version": "2.0"},
    "extensionsUsed": ["KHR_mesh_quantization", "KHR_texture_transform", "GODOT_single_root"],
    "accessors": [{"type": "VEC3", "componentType": 5122, "count": 3}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]})");
  const std::string out = here({"a.gltf"}).out;
  EXPECT_THAT(out, HasSubstr("used      1 accessor has its formats"));
  EXPECT_THAT(out,
              HasSubstr("KHR_texture_transform  ratified           used      no object has it"));
  EXPECT_EQ(out.find("object has it"), out.rfind("object has it"))
      << "nothing is told of the third: " << out;
}

TEST_F(Inspect, LegacyObjectsAreToldWithWhatUpgradeMakesOfThem) {
  const Outcome outcome =
      here({fixture("legacy/awning.gltf"), fixture("legacy/on-request/candle.gltf")});
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("What 'gltfx upgrade' changes"),
                                 HasSubstr("KHR_materials_diffuse_transmission  safe"),
                                 HasSubstr("left alone: on request")));
}

TEST_F(Inspect, JsonHasTheSameForEachAsset) {
  const Outcome outcome = here({GLTFX_SOURCE_DIR "/fixtures", "--format", "json", "--jobs", "2"});
  EXPECT_EQ(outcome.code, 3);  // one of them is not glTF
  const json report = json::parse(outcome.out);
  EXPECT_GT(report["assets"].size(), 60U);
  for (const json& asset : report["assets"]) {
    if (asset.contains("error")) continue;
    const json& bytes = asset["facts"]["bytes"];
    std::uint64_t sum = 0;
    for (const auto& part : bytes.items()) {
      if (part.key() != "total") sum += part.value().get<std::uint64_t>();
    }
    EXPECT_EQ(sum, bytes["total"]) << asset["path"];
  }
}

TEST_F(Inspect, TellsWhyNothingIsSeen) {
  const std::string begin = R"({"asset": {"version": "2.0")";
  const std::string end = R"(}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "scale": [0, 0, 0]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3,
                   "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36, "target": 34962}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  folder_.write("unseen.gltf", begin + end);
  folder_.write("broken.gltf", begin + R"(, "minVersion": 2)" + end);
  EXPECT_THAT(here({"unseen.gltf"}).out,
              AllOf(HasSubstr("What it shows"), HasSubstr("warning[NOTHING_VISIBLE]"),
                    HasSubstr("node 0 or a parent of it is scaled to 0")));
  EXPECT_THAT(here({"broken.gltf"}).out, HasSubstr("The asset has 1 error"));
  const json report =
      json::parse(here({"unseen.gltf", "broken.gltf", "--format", "json"}).out)["assets"];
  ASSERT_EQ(report[0]["shows"].size(), 1U);
  EXPECT_EQ(report[0]["shows"][0]["code"], "NOTHING_VISIBLE");
  EXPECT_EQ(report[0]["shows"][0]["pointer"], "/nodes/0");
  EXPECT_TRUE(report[1]["shows"].empty());
  EXPECT_TRUE(report[1].contains("showsProblem"));
}

TEST_F(Inspect, TextsOfMegabytesAreCut) {
  const std::string text(2'000'000, 'x');
  folder_.write("a.gltf", R"({"asset": {"version": "2.0", "generator": ")" + text +
                              R"(", "copyright": ")" + text + R"("}, "materials": [{"name": ")" +
                              text + R"("}]})");
  for (const std::string format : {"text", "json"}) {
    const Outcome outcome =
        gltfx({"inspect", "a.gltf", "--format", format}, {folder_.path().native(), {}, {}});
    EXPECT_THAT(outcome.out, HasSubstr("xxx…"));
    EXPECT_LT(outcome.out.size(), std::size_t{1} << 16U) << format;
  }
  const Outcome khronos =
      gltfx({"validate", "a.gltf", "--profile", "khronos", "--format", "khronos"},
            {folder_.path().native(), {}, {}});
  EXPECT_LT(khronos.out.size(), std::size_t{1} << 14U);
}

TEST_F(Inspect, TopLimitsRows) {
  std::string meshes;
  for (int i = 0; i < 12; ++i) meshes += R"({"name": "m)" + std::to_string(i) + R"("},)";
  folder_.write("many.gltf",
                R"({"asset": {"version": "2.0"}, "meshes": [)" + meshes + R"({"name": "last"}]})");
  EXPECT_THAT(here({"many.gltf"}).out,
              AllOf(HasSubstr("Meshes, 10 of 13"), Not(HasSubstr("last"))));
  EXPECT_THAT(here({"many.gltf", "--top", "0"}).out, HasSubstr("last"));
  EXPECT_THAT(here({"many.gltf", "--top", "x"}).err, HasSubstr("--top: 'x' is not a whole number"));
}

TEST_F(Inspect, RootSchemaAndConfigurationCount) {
  folder_.write("data.bin", std::string(8, 'x'));
  folder_.write("in/a.gltf", R"({"asset": {"version": "2.0"}, "extensionsUsed": ["ACME_leaf"],
    "buffers": [{"byteLength": 8, "uri": "../data.bin"}]})");
  folder_.write("ACME_leaf.schema.json",
                R"({"$schema": "https://json-schema.org/draft/2020-12/schema",
    "$id": "gltfx:ext/ACME_leaf", "title": "ACME_leaf", "description": "A leaf.", "type": "object",
    "x-gltfx": {"extension": "ACME_leaf", "on": ["material"], "status": "vendor"}})");
  EXPECT_THAT(here({"in/a.gltf"}).out, AllOf(HasSubstr("Not read"), HasSubstr("unknown")));
  const std::string out =
      here({"in/a.gltf", "--root", ".", "--schema", "ACME_leaf.schema.json"}).out;
  EXPECT_THAT(out, AllOf(HasSubstr("in 2 files"), HasSubstr("vendor"), Not(HasSubstr("Not read"))));
  EXPECT_EQ(here({"in/a.gltf", "--root", ".", "--schema-dir", "."}).out, out);
  folder_.write("gltfx.toml", "root = \".\"\nschemas = [\"ACME_leaf.schema.json\"]\n");
  EXPECT_EQ(here({"in/a.gltf"}).out, out);
  EXPECT_EQ(here({"in/a.gltf", "--config", "gltfx.toml"}).out, out);
  EXPECT_THAT(here({"in/a.gltf", "--isolated"}).out, HasSubstr("Not read"));
}

TEST_F(Inspect, WhatCannotBeReadIsAnExitCode) {
  folder_.write("broken.gltf", "{");
  folder_.write("sound.gltf", kSound);
  const Outcome outcome = here({"broken.gltf", "sound.gltf", "gone.gltf"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("broken.gltf: its JSON is invalid"), HasSubstr("gone.gltf")));
  EXPECT_THAT(outcome.out, HasSubstr("sound.gltf"));
  EXPECT_EQ(here({}).code, 2);
  EXPECT_EQ(here({"-"}).code, 2);
  EXPECT_EQ(here({"sound.gltf", "--format", "xml"}).code, 2);
  folder_.write("empty/readme", "");
  EXPECT_THAT(here({"empty"}).err, HasSubstr("no .gltf, .glb or .vrm in 'empty'"));
  EXPECT_THAT(here({"empty", "sound.gltf"}).err,
              HasSubstr("note: no .gltf, .glb or .vrm in 'empty'"));
  EXPECT_THAT(here({"empty", "sound.gltf", "--quiet"}).err, IsEmpty());
}

TEST_F(Inspect, TextOfAnAssetStaysText) {
  folder_.write("a.gltf", R"({"asset": {"version": "2.0", "generator": "\u001b[2J##vso[x]"},
    "meshes": [{"name": "\u202Eevil\n::error::"}], "extensionsUsed": ["\u0007"]})");
  const std::string out = here({"a.gltf", "--color", "always"}).out;
  EXPECT_THAT(
      out, AllOf(Not(HasSubstr("\x1b[2J")), Not(HasSubstr("##vso[")), Not(HasSubstr("\n::error")),
                 Not(HasSubstr("\x07")), Not(HasSubstr("\xE2\x80\xAE"))));
}

}  // namespace
}  // namespace gltfx::program
