// SPDX-License-Identifier: Apache-2.0
// Lobes that hide each other or are switched off.
#include <string>

#include <gtest/gtest.h>

#include "rules/part.hpp"

namespace gltfx::test {
namespace {

const std::string kLobeAt = " /materials/0/extensions/KHR_materials_";

Lines lobes(const std::string& material, const std::string& more = {},
            Profile profile = Profile::standard) {
  return findings(R"("materials": [{)" + material + "}]" + more,
                  {"KHR_MATERIALS_IOR", "KHR_MATERIALS_TRANSMISSION", "KHR_MATERIALS_UNLIT",
                   "KHR_MATERIALS_DISPERSION_UNUSUAL", "MATERIAL_LOBE"},
                  profile);
}

// A material with these extensions that is not metallic.
std::string with(const std::string& extensions, const std::string& more = {}) {
  return R"("pbrMetallicRoughness": {"metallicFactor": 0}, "extensions": {)" + extensions + "}" +
         more;
}

const std::string kGlass = R"("KHR_materials_transmission": {"transmissionFactor": 1})";

TEST(Lobes, AnIndexOfZeroDoesNotRefract) {
  const auto volume = [](const std::string& ior, const std::string& thickness) {
    return lobes(with(kGlass + R"(, "KHR_materials_ior": {"ior": )" + ior +
                      R"(}, "KHR_materials_volume": {"thicknessFactor": )" + thickness + "}"));
  };
  EXPECT_EQ(volume("0", "1"), Lines{"KHR_MATERIALS_IOR_ZERO_VOLUME" + kLobeAt + "ior/ior"});
  EXPECT_EQ(volume("1.5", "1"), Lines{});
  EXPECT_EQ(volume("0", "0"), Lines{}) << "a thin wall";
}

std::string animating(const std::string& pointer) {
  return R"(, "animations": [{"channels": [{"sampler": 0, "target": {"path": "pointer",
      "extensions": {"KHR_animation_pointer": {"pointer": ")" +
         pointer + R"("}}}}], "samplers": []}])";
}

TEST(Lobes, AnIndexOfZeroIsNotAnimated) {
  const auto animated = [](const std::string& ior, const std::string& property) {
    return lobes(with(R"("KHR_materials_ior": {"ior": )" + ior + "}"),
                 animating("/materials/0/extensions/KHR_materials_ior/" + property));
  };
  EXPECT_EQ(animated("0", "ior"), Lines{"KHR_MATERIALS_IOR_ZERO_ANIMATED" + kLobeAt + "ior/ior"});
  EXPECT_EQ(animated("1", "ior"), Lines{});
  EXPECT_EQ(animated("0", "other"), Lines{});
}

TEST(Lobes, MetalLetsNoLightThrough) {
  const auto transmitting = [](const std::string& base, const std::string& more = {}) {
    return lobes(R"("pbrMetallicRoughness": {)" + base + R"(}, "extensions": {)" + kGlass + "}",
                 more, Profile::strict);
  };
  const Lines metal{"KHR_MATERIALS_TRANSMISSION_METAL" + kLobeAt + "transmission"};
  EXPECT_EQ(transmitting(""), metal) << "metallicFactor is 1 by default";
  EXPECT_EQ(transmitting(R"("metallicFactor": 1)"), metal);
  EXPECT_EQ(transmitting(R"("metallicFactor": 0.9)"), Lines{});
  EXPECT_EQ(transmitting(R"("metallicRoughnessTexture": {"index": 0})"), Lines{});
  EXPECT_EQ(transmitting("", animating("/materials/0/pbrMetallicRoughness/metallicFactor")),
            Lines{});
  EXPECT_EQ(lobes(R"("extensions": {"KHR_materials_diffuse_transmission":
                     {"diffuseTransmissionFactor": 0.5}})",
                  "", Profile::strict),
            Lines{"KHR_MATERIALS_TRANSMISSION_METAL" + kLobeAt + "diffuse_transmission"});
}

TEST(Lobes, TransmissionIsNoCoverage) {
  const auto glass = [](const std::string& mode, const std::string& base = {},
                        const std::string& more = {}) {
    return lobes(R"("alphaMode": ")" + mode + R"(", "pbrMetallicRoughness": {"metallicFactor": 0)" +
                     base + R"(}, "extensions": {)" + kGlass + "}",
                 more);
  };
  const Lines blended{"KHR_MATERIALS_TRANSMISSION_ALPHA_MODE" + kLobeAt + "transmission"};
  EXPECT_EQ(glass("BLEND"), blended);
  EXPECT_EQ(glass("MASK"), blended);
  EXPECT_EQ(glass("OPAQUE"), Lines{});
  EXPECT_EQ(glass("BLEND", R"(, "baseColorFactor": [1, 1, 1, 1])"), blended);
  EXPECT_EQ(glass("BLEND", R"(, "baseColorFactor": [1, 1, 1, 0.5])"), Lines{});
  EXPECT_EQ(glass("BLEND", R"(, "baseColorTexture": {"index": 0})"), Lines{});
  EXPECT_EQ(glass("BLEND", "", R"(, "meshes": [{"primitives": [{"attributes": {"COLOR_0": 0},
      "material": 0}]}], "accessors": [{"componentType": 5126, "count": 1, "type": "VEC4"}])"),
            Lines{});
}

TEST(Lobes, UnlitMaterialsNeedNoTexturesForLighting) {
  const std::string material =
      R"("normalTexture": {"index": 0}, "extensions": {"KHR_materials_unlit": {}})";
  EXPECT_EQ(lobes(material), Lines{});
  EXPECT_EQ(lobes(material, "", Profile::strict),
            (Lines{"KHR_MATERIALS_UNLIT_FALLBACK" + kLobeAt + "unlit",
                   "KHR_MATERIALS_UNLIT_TEXTURE /materials/0/normalTexture"}));
  EXPECT_EQ(lobes(R"("pbrMetallicRoughness": {"metallicFactor": 0, "metallicRoughnessTexture":
      {"index": 0}}, "extensions": {"KHR_materials_unlit": {}})",
                  "", Profile::strict),
            Lines{"KHR_MATERIALS_UNLIT_TEXTURE /materials/0/pbrMetallicRoughness/"
                  "metallicRoughnessTexture"});
}

TEST(Lobes, UnlitMaterialsLookAlikeWithoutTheExtension) {
  const auto unlit = [](const std::string& members, const std::string& more = {}) {
    return lobes(members + R"("extensions": {"KHR_materials_unlit": {}})", more, Profile::strict);
  };
  const Lines wrong{"KHR_MATERIALS_UNLIT_FALLBACK" + kLobeAt + "unlit"};
  EXPECT_EQ(unlit(""), wrong) << "metal, by default";
  EXPECT_EQ(unlit(R"("pbrMetallicRoughness": {"metallicFactor": 0}, )"), Lines{});
  EXPECT_EQ(unlit(R"("pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.5}, )"),
            wrong);
  EXPECT_EQ(unlit(R"("pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.6}, )"),
            Lines{});
  EXPECT_EQ(
      unlit(R"("pbrMetallicRoughness": {"metallicFactor": 0}, "emissiveFactor": [0, 0, 1], )"),
      wrong);
  EXPECT_EQ(
      unlit(R"("pbrMetallicRoughness": {"metallicFactor": 0}, "emissiveFactor": [0, 0, 0], )"),
      Lines{});
  EXPECT_EQ(unlit("", R"(, "extensionsRequired": ["KHR_materials_unlit"])"), Lines{})
      << "all readers support it";
}

TEST(Lobes, AColourThatIsBlackSwitchesOff) {
  const auto sheen = [](const std::string& color) {
    return lobes(with(R"("KHR_materials_sheen": {"sheenRoughnessFactor": 0.5)" + color + "}"));
  };
  const Lines off{"MATERIAL_LOBE_OFF" + kLobeAt + "sheen"};
  EXPECT_EQ(sheen(""), off);
  EXPECT_EQ(sheen(R"(, "sheenColorFactor": [0, 0, 0])"), off);
  EXPECT_EQ(sheen(R"(, "sheenColorFactor": [0, 0, 0.1])"), Lines{});
  EXPECT_EQ(sheen(R"(, "sheenColorFactor": "red")"), Lines{}) << "which is told elsewhere";
}

TEST(Lobes, AnAbbeNumberIsNoDispersion) {
  const auto dispersion = [](const std::string& value) {
    return lobes(with(R"("KHR_materials_dispersion": {"dispersion": )" + value + "}"), "",
                 Profile::strict);
  };
  EXPECT_EQ(dispersion("55"),
            Lines{"KHR_MATERIALS_DISPERSION_UNUSUAL" + kLobeAt + "dispersion/dispersion"});
  EXPECT_EQ(dispersion("2.04"), Lines{});
}

TEST(Lobes, ThatAreOffAreSetUpForNothing) {
  const auto clearcoat = [](const std::string& members, const std::string& more = {}) {
    return lobes(with(R"("KHR_materials_clearcoat": {)" + members + "}"), more);
  };
  const Lines off{"MATERIAL_LOBE_OFF" + kLobeAt + "clearcoat"};
  EXPECT_EQ(clearcoat(R"("clearcoatRoughnessFactor": 0.3)"), off);
  EXPECT_EQ(clearcoat(R"("clearcoatFactor": 0, "clearcoatRoughnessFactor": 0.3)"), off);
  EXPECT_EQ(clearcoat(R"("clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.3)"), Lines{});
  EXPECT_EQ(clearcoat(R"("clearcoatFactor": 0)"), Lines{}) << "nothing else is set up";
  EXPECT_EQ(clearcoat(""), Lines{});
  EXPECT_EQ(clearcoat(R"("clearcoatRoughnessFactor": 0.3)",
                      animating("/materials/0/extensions/KHR_materials_clearcoat/clearcoatFactor")),
            Lines{});
  EXPECT_EQ(clearcoat(R"("clearcoatTexture": {"index": 0})"), Lines{}) << "said of the texture";
  EXPECT_EQ(lobes(with(kGlass + R"(, "KHR_materials_volume": {"attenuationDistance": 1})")),
            Lines{"MATERIAL_LOBE_OFF" + kLobeAt + "volume"});
}

}  // namespace
}  // namespace gltfx::test
