// SPDX-License-Identifier: Apache-2.0
// A legacy material and what it is upgraded to are drawn with the same bytes; and the same asset is
// drawn with the same bytes whenever it is, by however many threads.
#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>

#include "pipeline/baking.hpp"
#include "pipeline/legacy_scenes.hpp"

namespace gltfx::test {
namespace {

namespace fs = std::filesystem;

BakeOptions quick_legacy() {
  BakeOptions options;
  options.sizes = {{32, 24}};
  options.samples = 4;
  options.jobs = 1;
  return options;
}

// All that an upgrade of this fixture is said to lose: nothing.
bool loses_nothing(const UpgradeReport& report) {
  return report.written &&
         std::all_of(report.actions.begin(), report.actions.end(), [](const auto& action) {
           return action.done && !action.lossy && action.outcome == UpgradeOutcome::safe;
         });
}

fs::path legacy_folder() { return fs::path(GLTFX_SOURCE_DIR) / "fixtures" / "legacy"; }

TEST(LegacyFixturesBaked, LookAsTheyDidToTheLastBit) {
  int drawn = 0;
  for (const bool pack : {false, true}) {
    for (const auto& entry : fs::directory_iterator(legacy_folder())) {
      const std::string ending = entry.path().extension();
      if (ending != ".gltf" && ending != ".glb") continue;
      const container::test::TempFolder folder;
      UpgradeOptions options;
      options.pack = pack;
      options.output = (folder.path() / entry.path().filename()).native();
      if (!loses_nothing(upgrade_file(entry.path().native(), options))) continue;
      const BakeReport before = bake_file(entry.path().native(), quick_legacy());
      const BakeReport after = bake_file(options.output, quick_legacy());
      EXPECT_EQ(before.problem, after.problem) << entry.path() << after.error;
      EXPECT_EQ(before.pixels.bytes, after.pixels.bytes) << entry.path();
      if (!before.pixels.bytes.empty()) ++drawn;
    }
  }
  EXPECT_GE(drawn, 2);
}

struct Generation {
  const char* name;
  bool pack;
};
void PrintTo(const Generation& generation, std::ostream* out) {
  *out << generation.name << (generation.pack ? " packed" : "");
}

class LegacyBaked : public testing::TestWithParam<Generation> {};

// Squares side by side that face either way, each of a material of its own, with lamps on both
// sides.
Json with_squares(Json document) {
  const SharedArray<Float3> points = render::quad(0.45F).positions;
  std::string bytes = packed(points);
  bytes += packed(render::quad().uvs[0]);
  bytes += floats({0.2F, 0.1F, 0.9F, 0.3F, 0.7F, 1.1F, -0.2F, 0.6F});
  bytes += packed(render::quad().triangles);
  document["buffers"] = {{{"byteLength", bytes.size()}, {"uri", buffer_uri(bytes)}}};
  const auto view = [&](std::size_t offset, std::size_t length, const char* type, int component,
                        int count) {
    const std::size_t index = document.contains("bufferViews") ? document["bufferViews"].size() : 0;
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}});
    document["accessors"].push_back(
        {{"bufferView", index}, {"componentType", component}, {"count", count}, {"type", type}});
  };
  view(0, 48, "VEC3", 5126, 4);
  document["accessors"][0]["min"] = {-0.45F, -0.45F, 0};
  document["accessors"][0]["max"] = {0.45F, 0.45F, 0};
  view(48, 32, "VEC2", 5126, 4);
  view(80, 32, "VEC2", 5126, 4);
  view(112, 24, "SCALAR", 5125, 6);
  const std::size_t count = document["materials"].size();
  for (std::size_t i = 0; i < count; ++i) {
    document["materials"][i]["doubleSided"] = true;
    document["meshes"].push_back(
        {{"primitives",
          {{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}, {"TEXCOORD_1", 2}}},
            {"indices", 3},
            {"material", i}}}}});
    Json node{{"mesh", i}, {"translation", {i % 4, i / 4, 0}}};
    if (i % 2 == 1) node["rotation"] = {0, 1, 0, 0};
    document["nodes"].push_back(node);
    document["scenes"][0]["nodes"].push_back(i);
  }
  for (const double z : {-2.0, 3.0}) {
    document["scenes"][0]["nodes"].push_back(document["nodes"].size());
    document["nodes"].push_back(
        {{"translation", {1, 1, z}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  }
  document["extensionsUsed"].push_back("KHR_lights_punctual");
  document["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 2}}};
  document["scene"] = 0;
  return document;
}

TEST_P(LegacyBaked, LooksAsItDidToTheLastBit) {
  const auto& [generation, pack] = GetParam();
  const bool first = std::string_view(generation) == "v1";
  Random random(pack ? 21 : 20);
  for (int i = 0; i < 3; ++i) {
    LegacyScene scene(random, all_pictures(random), first);
    for (int k = 0; k < 12; ++k) scene.add_material();
    const container::test::TempFolder folder;
    const std::string before =
        folder.write("before.gltf", with_squares(scene.json()).dump()).native();
    UpgradeOptions options;
    options.generation = generation;
    options.pack = pack;
    options.output = (folder.path() / "after.gltf").native();
    const UpgradeReport report = upgrade_file(before, options);
    ASSERT_TRUE(loses_nothing(report)) << report.error;
    BakeOptions baked = quick_legacy();
    baked.sizes = {{48, 40}};
    baked.cameras = {"20,10"};
    const BakeReport old = bake_file(before, baked);
    const BakeReport fresh = bake_file(options.output, baked);
    ASSERT_EQ(old.problem, BakeProblem::none) << old.error;
    ASSERT_EQ(fresh.problem, BakeProblem::none) << fresh.error;
    // An asset may have errors that no material can mend.
    EXPECT_THAT(old.notes, testing::Each(testing::HasSubstr("what can be drawn is drawn")));
    EXPECT_EQ(old.pixels.bytes, fresh.pixels.bytes) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Generations, LegacyBaked,
                         testing::Values(Generation{"v1", false}, Generation{"v1", true},
                                         Generation{"v2", false}),
                         [](const auto& chosen) {
                           return std::string(chosen.param.name) +
                                  (chosen.param.pack ? "_packed" : "");
                         });

// Textures, media, alpha, lamps of every kind, copies, a denoiser: all that could depend on who
// comes first.
TEST(BakedAgain, TheSameBytesByAnyNumberOfThreadsAndEachTime) {
  Random random(5);
  LegacyScene scene(random, all_pictures(random), false);
  for (int k = 0; k < 12; ++k) scene.add_material();
  Json document = with_squares(scene.json());
  for (std::size_t i = 0; i < 12; ++i) {
    Json& material = document["materials"][i];
    if (i % 3 == 0) material["alphaMode"] = "BLEND";
    if (i % 3 == 0) material["pbrMetallicRoughness"]["baseColorFactor"] = {1, 0.5, 0.2, 0.5};
    if (i % 3 != 1) continue;
    material["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", 0.7}};
    material["extensions"]["KHR_materials_volume"] = {{"thicknessFactor", 0.2},
                                                      {"attenuationDistance", 1},
                                                      {"attenuationColor", {0.9, 0.5, 0.4}}};
    material["extensions"]["KHR_materials_sss"] = {{"scatterDistance", 0.4},
                                                   {"scatterColor", {0.5, 0.4, 0.3}}};
  }
  for (const Json& light : {Json{{"type", "directional"}, {"intensity", 1}},
                            Json{{"type", "spot"}, {"intensity", 5}, {"spot", Json::object()}}}) {
    const std::size_t index = document["extensions"]["KHR_lights_punctual"]["lights"].size();
    document["extensions"]["KHR_lights_punctual"]["lights"].push_back(light);
    document["scenes"][0]["nodes"].push_back(document["nodes"].size());
    document["nodes"].push_back({{"translation", {1, 1, 4}},
                                 {"mesh", 0},
                                 {"scale", {1, -1, 1}},
                                 {"extensions", {{"KHR_lights_punctual", {{"light", index}}}}}});
  }
  const container::test::TempFolder folder;
  const std::string path = folder.write("a.gltf", document.dump()).native();
  for (const bool denoise : {false, true}) {
    BakeOptions options = quick_legacy();
    options.sizes = {{56, 40}};
    options.denoise = denoise;
    options.noise = denoise ? 0 : 0.02;
    options.samples = 18;
    const BakeReport one = bake_file(path, options);
    ASSERT_EQ(one.problem, BakeProblem::none) << one.error;
    EXPECT_EQ(one.pixels.bytes, bake_file(path, options).pixels.bytes);
    for (const unsigned jobs : {2U, 5U, 0U}) {
      options.jobs = jobs;
      EXPECT_EQ(one.pixels.bytes, bake_file(path, options).pixels.bytes) << jobs;
    }
  }
}

}  // namespace
}  // namespace gltfx::test
