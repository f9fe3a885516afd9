// SPDX-License-Identifier: Apache-2.0
// Vertex colours tint the light that passes through a first-generation material. After an upgrade
// they still do.
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "pipeline/tint_support.hpp"

namespace gltfx::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(VertexTint, OneColourGoesIntoTheFactor) {
  Scene scene;
  scene.add_uniform(51, 255, 102);
  scene.add_uniform(51, 255, 102);
  const Upgraded result = upgraded(scene);
  EXPECT_EQ(result.action().outcome, UpgradeOutcome::safe);
  EXPECT_THAT(result.action().notes,
              Contains(HasSubstr("COLOR_0 is multiplied into diffuseTransmissionColorFactor")));
  EXPECT_EQ(result.extension()["diffuseTransmissionColorFactor"], Json({0.1, 0.25, 0.4}));
  EXPECT_EQ(result.json["materials"].size(), 1U);
}

TEST(VertexTint, ShortsAndFloatsAreColoursToo) {
  Scene scene;
  std::size_t at = scene.add_primitive();
  scene.primitive(at)["attributes"]["COLOR_0"] = scene.add_accessor(
      bytes_of<float>({0.5, 1, 0.25, 0.5, 1, 0.25, 0.5, 1, 0.25}), kFloat, "VEC3", 3);
  EXPECT_EQ(upgraded(scene).extension()["diffuseTransmissionColorFactor"],
            Json({0.25, 0.25, 0.25}));
  scene.primitive(at)["attributes"]["COLOR_0"] = scene.add_accessor(
      bytes_of<std::uint16_t>(std::vector<std::uint16_t>(12, 0xFFFF)), kShort, "VEC4", 3);
  const Upgraded white = upgraded(scene);
  EXPECT_EQ(white.extension()["diffuseTransmissionColorFactor"], Json({0.5, 0.25, 1}));
  EXPECT_EQ(white.action().outcome, UpgradeOutcome::safe);
}

TEST(VertexTint, WithoutABaseColourTheFactorIsTheVertexColour) {
  Scene scene;
  scene.json()["materials"][0].erase("pbrMetallicRoughness");
  scene.add_uniform(51, 255, 0);
  EXPECT_EQ(upgraded(scene).extension()["diffuseTransmissionColorFactor"], Json({0.2, 1, 0}));
}

TEST(VertexTint, ColoursThatDifferSplitTheMaterial) {
  Scene scene;
  scene.add_uniform(51, 51, 51);
  scene.add_primitive();  // white
  scene.add_uniform(51, 51, 51);
  scene.add_uniform(0, 255, 0);
  scene.json()["materials"].push_back({{"name", "other"}});
  const Upgraded result = upgraded(scene);
  EXPECT_EQ(result.action().outcome, UpgradeOutcome::safe);
  EXPECT_THAT(result.action().notes, Contains(HasSubstr("the material is duplicated (2 copies)")));
  const Json& materials = result.json["materials"];
  ASSERT_EQ(materials.size(), 4U);
  std::vector<int> users;
  for (const Json& primitive : result.json["meshes"][0]["primitives"]) {
    users.push_back(primitive["material"]);
  }
  EXPECT_THAT(users, ElementsAre(0, 2, 0, 3));
  EXPECT_EQ(result.extension(0)["diffuseTransmissionColorFactor"], Json({0.1, 0.05, 0.2}));
  EXPECT_EQ(result.extension(2)["diffuseTransmissionColorFactor"], Json({0.5, 0.25, 1}));
  EXPECT_EQ(result.extension(3)["diffuseTransmissionColorFactor"], Json({0, 0.25, 0}));
  for (const std::size_t copy : {2U, 3U}) {
    EXPECT_EQ(materials[copy]["name"], "leaf");
    EXPECT_EQ(materials[copy]["pbrMetallicRoughness"], materials[0]["pbrMetallicRoughness"]);
    EXPECT_EQ(result.extension(copy)["diffuseTransmissionFactor"], 0.5);
    EXPECT_EQ(materials[copy]["extensions"].size(), 1U);
  }
}

TEST(VertexTint, MappingsOfVariantsFollowTheirPrimitive) {
  Scene scene;
  scene.json()["materials"].insert(scene.json()["materials"].begin(), Json{{"name", "other"}});
  scene.json()["extensionsUsed"].push_back("KHR_materials_variants");
  scene.json()["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "summer"}}};
  for (const std::uint8_t shade : {std::uint8_t{255}, std::uint8_t{51}}) {
    Json& primitive = scene.primitive(scene.add_uniform(shade, shade, shade));
    primitive["extensions"]["KHR_materials_variants"]["mappings"] = {
        {{"material", 1}, {"variants", {0}}}};
  }
  const Upgraded result = upgraded(scene);
  EXPECT_EQ(result.action().outcome, UpgradeOutcome::safe);
  const auto mapped = [&](std::size_t primitive) {
    return result.json["meshes"][0]["primitives"][primitive]["extensions"]["KHR_materials_variants"]
                      ["mappings"][0]["material"];
  };
  EXPECT_EQ(mapped(0), 1);
  EXPECT_EQ(mapped(1), 2);
  EXPECT_EQ(result.json["meshes"][0]["primitives"][1]["material"], 0);
  EXPECT_EQ(result.extension(2)["diffuseTransmissionColorFactor"], Json({0.1, 0.05, 0.2}));
}

struct Doubtful {
  const char* reason;
  void (*spoil)(Scene& scene);
};

class VertexTintOfDoubtful : public testing::TestWithParam<Doubtful> {};

TEST_P(VertexTintOfDoubtful, ColoursIsALossWithItsReason) {
  Scene scene;
  scene.add_uniform(51, 51, 51);
  GetParam().spoil(scene);
  const Upgraded result = upgraded(scene);
  EXPECT_EQ(result.action().outcome, UpgradeOutcome::unsafe);
  EXPECT_THAT(result.action().notes, Contains(HasSubstr(GetParam().reason)));
  EXPECT_FALSE(result.report.written);
}

INSTANTIATE_TEST_SUITE_P(
    All, VertexTintOfDoubtful,
    testing::Values(
        Doubtful{"differs between vertices",
                 [](Scene& scene) {
                   scene.add_colored({{1, 2, 3, 4}, {1, 2, 3, 4}, {1, 2, 4, 4}});
                 }},
        Doubtful{"is changed by morph targets",
                 [](Scene& scene) {
                   scene.primitive(0)["targets"] = {{{"COLOR_0", 1}}};
                 }},
        Doubtful{"is compressed",
                 [](Scene& scene) {
                   scene.primitive(0)["extensions"]["KHR_draco_mesh_compression"] = {
                       {"bufferView", 0}, {"attributes", {{"COLOR_0", 1}}}};
                 }},
        Doubtful{"cannot be read",
                 [](Scene& scene) { scene.json()["accessors"][1]["count"] = 3000; }},
        Doubtful{"cannot be read",
                 [](Scene& scene) { scene.json()["accessors"][1].erase("normalized"); }},
        Doubtful{"cannot be read",
                 [](Scene& scene) { scene.json()["accessors"][1].erase("bufferView"); }},
        Doubtful{"cannot be read",
                 [](Scene& scene) {
                   scene.json()["bufferViews"][1]["extensions"]["EXT_meshopt_compression"] = {};
                 }},
        Doubtful{"is outside 0 to 1",
                 [](Scene& scene) {
                   scene.primitive(0)["attributes"]["COLOR_0"] =
                       scene.add_accessor(bytes_of(std::vector<float>(9, 1.5F)), kFloat, "VEC3", 3);
                 }},
        Doubtful{"references the material", [](Scene& scene) {
                   scene.add_primitive();
                   scene.animate("/materials/0/pbrMetallicRoughness/roughnessFactor",
                                 scene.add_accessor(bytes_of<float>({0, 1}), kFloat, "SCALAR", 2));
                 }}));

}  // namespace
}  // namespace gltfx::test
