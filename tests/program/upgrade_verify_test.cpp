// SPDX-License-Identifier: Apache-2.0
// `gltfx upgrade --verify`: the picture before and after.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "model/packed_bytes.hpp"
#include "sanitized.hpp"
#include "upgrade_support.hpp"

namespace gltfx::program {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// A translucent square, red on one side and blue on the other by its vertices. The successor has a
// colour of its own, which vertex colours do not multiply, so that the upgrade is lossy.
std::string painted() {
  const std::string bytes = test::floats({-1, 0, 0, 1, 0, 0, 1, 2, 0, -1, 2, 0}) +
                            test::floats({1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0}) +
                            test::packed<std::uint16_t>({0, 1, 2, 0, 2, 3});
  return R"({
  "asset": { "version": "2.0" },
  "extensionsUsed": ["KHR_materials_translucency"],
  "scene": 0,
  "scenes": [{ "nodes": [0] }],
  "nodes": [{ "mesh": 0 }],
  "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "COLOR_0": 1 }, "indices": 2,
    "material": 0 }] }],
  "materials": [{ "doubleSided": true, "pbrMetallicRoughness": { "metallicFactor": 0 },
    "extensions": { "KHR_materials_translucency": { "translucencyFactor": 1 } } }],
  "buffers": [{ "byteLength": 108, "uri": ")" +
         test::buffer_uri(bytes) + R"(" }],
  "bufferViews": [
    { "buffer": 0, "byteLength": 48 },
    { "buffer": 0, "byteOffset": 48, "byteLength": 48 },
    { "buffer": 0, "byteOffset": 96, "byteLength": 12 }
  ],
  "accessors": [
    { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, 0, 0], "max": [1, 2, 0] },
    { "bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3" },
    { "bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR" }
  ]
})";
}

class UpgradeVerifyTest : public UpgradeTest {
 protected:
  UpgradeVerifyTest() {
    folder_.write("painted.gltf", painted());
    folder_.write("poster.gltf", read_file(fixture("legacy/poster.gltf")));
  }
};

TEST_F(UpgradeVerifyTest, WritesWhatLooksAsItDid) {
  const Outcome outcome = here({"poster.gltf", "--verify", "--in-place"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("  verified: the picture is the same\n"),
                                 HasSubstr("1 file written")));
  EXPECT_EQ(content("poster.gltf"), read_file(fixture("legacy/upgraded/poster.gltf")));
}

TEST_F(UpgradeVerifyTest, RefusesAnUpgradeThatChangesThePicture) {
  EXPECT_EQ(here({"painted.gltf", "--unsafe", "-o", "new.gltf"}).code, 0) << "without --verify";
  const std::string before = content("painted.gltf");
  const auto files = names();
  std::vector<std::vector<std::string>> ways{{"--in-place", "--backup"}};
  if (!kSanitized) ways.insert(ways.end(), {{"-o", "other.gltf"}, {"--check"}, {}});
  for (const std::vector<std::string>& way : ways) {
    std::vector<std::string> words{"painted.gltf", "--unsafe", "--verify"};
    words.insert(words.end(), way.begin(), way.end());
    const Outcome outcome = here(words);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err,
                testing::ContainsRegex("painted.gltf: the picture would change by [1-9][0-9]+"
                                       "\\.[0-9] of 255 steps; noise explains at most "
                                       "[0-9]\\.[0-9] \\(--verify\\)"));
    EXPECT_THAT(outcome.out, Not(HasSubstr("verified")));
    EXPECT_EQ(content("painted.gltf"), before);
    EXPECT_EQ(names(), files);
  }
  const Outcome diff = here({"painted.gltf", "--unsafe", "--verify", "--diff"});
  EXPECT_EQ(diff.code, 1);
  EXPECT_THAT(diff.out, IsEmpty()) << "a patch of it is not offered";
}

TEST_F(UpgradeVerifyTest, GoesThroughAFolder) {
  const Outcome outcome = here({".", "--unsafe", "--verify", "-o", "new/"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("1 file written"));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "new/poster.gltf"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "new/painted.gltf"));
}

TEST_F(UpgradeVerifyTest, SaysSoWhereNothingCanBeCompared) {
  folder_.write("leaf.gltf", kLegacy);
  const Outcome outcome = here({"leaf.gltf", "--verify", "--in-place"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("  not verified: nothing in it is visible\n"));
  EXPECT_EQ(content("leaf.gltf"), kUpgraded);
  folder_.write("leaf.gltf", kLegacy);
  EXPECT_THAT(here({"leaf.gltf", "--verify", "--diff"}).err,
              HasSubstr("note: leaf.gltf: not verified: nothing in it is visible"));
  folder_.write("bottle.gltf", read_file(fixture("legacy/on-request/bottle.gltf")));
  EXPECT_THAT(here({"bottle.gltf", "--verify", "--only", "ADOBE_materials_thin_transparency"}).out,
              HasSubstr("not verified: gltfx does not draw ADOBE_materials_thin_transparency"));
}

TEST_F(UpgradeVerifyTest, SaysWhatCannotBeRead) {
  auto poster = nlohmann::json::parse(content("poster.gltf"));
  poster["meshes"][0]["primitives"][0]["attributes"]["_ID"] = poster["accessors"].size();
  poster["accessors"].push_back(
      {{"bufferView", 0}, {"componentType", 5126}, {"count", 1000000}, {"type", "SCALAR"}});
  folder_.write("poster.gltf", poster.dump(2));
  const Outcome outcome = here({"poster.gltf", "--verify", "--check"});
  EXPECT_THAT(outcome.out, HasSubstr("not verified: /meshes/0 cannot be read in either asset\n"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("  verified")));
}

TEST_F(UpgradeVerifyTest, IsPartOfTheJson) {
  folder_.write("leaf.gltf", kLegacy);
  const Outcome outcome =
      here({"leaf.gltf", "poster.gltf", "painted.gltf", "--verify", "--unsafe", "-f", "json"});
  const auto files = nlohmann::json::parse(outcome.out).at("files");
  EXPECT_FALSE(files.at(0).at("verified"));
  EXPECT_EQ(files.at(0).at("notVerified"), "nothing in it is visible");
  EXPECT_TRUE(files.at(1).at("verified"));
  EXPECT_FALSE(files.at(1).contains("notVerified"));
  EXPECT_FALSE(files.at(2).at("verified"));
  EXPECT_EQ(files.at(2).at("problem"), "refused");
}

}  // namespace
}  // namespace gltfx::program
