// SPDX-License-Identifier: Apache-2.0
// Specular-glossiness becomes metallic-roughness with a specular colour.
#include <gmock/gmock.h>

#include "support.hpp"

namespace gltfx::upgrade::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kName = "KHR_materials_pbrSpecularGlossiness";
const std::string kQuoted = R"("KHR_materials_pbrSpecularGlossiness":)";

// A document with one material: members of it, of the legacy object, of the root.
std::string document(const std::string& legacy, const std::string& material = "",
                     const std::string& root = "") {
  return R"({"extensionsUsed":[")" + kName + R"("],"textures":[{},{}],)" + root +
         R"("materials":[{)" + material + R"("extensions":{")" + kName + R"(":{)" + legacy +
         "}}}]}";
}

Json material_after(const std::string& legacy, const std::string& material = "") {
  return upgraded(document(legacy, material)).json()["materials"][0];
}

TEST(SpecularGlossiness, FactorsAndTexturesGoWhereTheyAreReadToday) {
  const Upgraded result = upgraded(
      document(R"("diffuseFactor":[0.50,0.8,0.2,1e0],"diffuseTexture":{"index":1,"texCoord":1},)"
               R"("specularFactor":[1,0.766,0.336],"glossinessFactor":0.9)"));
  EXPECT_EQ(result.json()["materials"][0].dump(),
            R"({"extensions":{"KHR_materials_specular":{"specularColorFactor":[1,0.766,0.336]},)"
            R"("KHR_materials_ior":{"ior":0}},"pbrMetallicRoughness":)"
            R"({"baseColorFactor":[0.5,0.8,0.2,1.0],"baseColorTexture":{"index":1,"texCoord":1},)"
            R"("metallicFactor":0,"roughnessFactor":0.1}})");
  EXPECT_THAT(result.text, HasSubstr("[0.50,0.8,0.2,1e0]"));  // numbers keep their spelling
  EXPECT_THAT(result.json()["extensionsUsed"],
              ElementsAre("KHR_materials_specular", "KHR_materials_ior"));
  EXPECT_EQ(result.only().fate, UpgradeFate::safe);
  EXPECT_FALSE(result.only().lossy);
}

TEST(SpecularGlossiness, DefaultsAreThoseOfTheOldModel) {
  EXPECT_EQ(material_after("").dump(),
            R"({"extensions":{"KHR_materials_specular":{},"KHR_materials_ior":{"ior":0}},)"
            R"("pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0}})");
}

TEST(SpecularGlossiness, RoughnessIsADecimalNumber) {
  const auto roughness = [](const std::string& glossiness) {
    const std::string text = upgraded(document(R"("glossinessFactor":)" + glossiness)).text;
    const std::string name = R"("roughnessFactor":)";
    const std::size_t begin = text.find(name) + name.size();
    return text.substr(begin, text.find('}', begin) - begin);
  };
  EXPECT_EQ(roughness("0.9"), "0.1");
  EXPECT_EQ(roughness("1"), "0");
  EXPECT_EQ(roughness("0"), "1");
  EXPECT_EQ(roughness("0.123456789"), "0.876543211");
  EXPECT_EQ(roughness("0.999999"), "0.000001");
}

TEST(SpecularGlossiness, TheFallbackGivesWay) {
  const Upgraded result = upgraded(document(
      R"("diffuseFactor":[0,0,0,1])",
      R"("pbrMetallicRoughness":{"baseColorFactor":[1,1,0,1],"baseColorTexture":{"index":0},)"
      R"("metallicFactor":0.0,"metallicRoughnessTexture":{"index":0},"extras":1},)"));
  EXPECT_EQ(result.json()["materials"][0]["pbrMetallicRoughness"].dump(),
            R"({"baseColorFactor":[0,0,0,1],"metallicFactor":0.0,"extras":1,"roughnessFactor":0})");
  EXPECT_THAT(result.only().notes,
              ElementsAre("pbrMetallicRoughness/baseColorFactor is overwritten",
                          "pbrMetallicRoughness/baseColorTexture is overwritten",
                          "pbrMetallicRoughness/metallicRoughnessTexture is overwritten"));
}

TEST(SpecularGlossiness, ARequiredExtensionLeavesRequiredOnes) {
  const Json root =
      upgraded(document("", "", R"("extensionsRequired":[")" + kName + R"("],)")).json();
  EXPECT_THAT(root["extensionsRequired"],
              ElementsAre("KHR_materials_specular", "KHR_materials_ior"));
}

TEST(SpecularGlossiness, AnotherIndexOfRefractionIsALoss) {
  UpgradeOptions options;
  options.ior = 1000;
  const Upgraded result = upgraded(document(""), options);
  EXPECT_EQ(result.json()["materials"][0]["extensions"]["KHR_materials_ior"].dump(),
            R"({"ior":1000})");
  EXPECT_TRUE(result.only().done);
  EXPECT_TRUE(result.only().lossy);
}

TEST(SpecularGlossiness, WhatItMustNotStandBesideIsSeenAfterwards) {
  std::string text = document("");
  text.insert(text.find(kQuoted), R"("KHR_materials_clearcoat":{},)");
  EXPECT_EQ(upgraded(text).text, text);
  EXPECT_EQ(upgraded(text).only().fate, UpgradeFate::unsafe);
  UpgradeOptions unsafe;
  unsafe.unsafe = true;
  EXPECT_TRUE(upgraded(text, unsafe).only().done);
}

TEST(SpecularGlossiness, BesideWhatTheSuccessorWouldBreakItStays) {
  for (const std::string other : {"KHR_materials_volume", "KHR_materials_specular",
                                  "KHR_materials_ior", "KHR_materials_unlit"}) {
    std::string text = document("");
    text.insert(text.find(kQuoted), std::string("\"").append(other).append("\":{},"));
    UpgradeOptions unsafe;
    unsafe.unsafe = true;
    const Upgraded result = upgraded(text, unsafe);
    EXPECT_EQ(result.text, text);
    EXPECT_EQ(result.only().fate, UpgradeFate::impossible);
    EXPECT_THAT(result.only().notes, Contains(HasSubstr(other)));
  }
}

TEST(SpecularGlossiness, TranslucencyBesideItTakesItsDiffuseColour) {
  std::string text = document(R"("diffuseFactor":[0.5,0.8,0.2,1],"diffuseTexture":{"index":1})",
                              R"("pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]},)");
  text.insert(text.find(kQuoted), R"("KHR_materials_translucency":{"translucencyFactor":0.7},)");
  const Upgraded result = upgraded(text);
  EXPECT_EQ(extension_of(result).dump(),
            R"({"diffuseTransmissionFactor":0.7,"diffuseTransmissionColorFactor":[0.5,0.8,0.2],)"
            R"("diffuseTransmissionColorTexture":{"index":1}})");
  EXPECT_THAT(upgraded(result.text).plan.actions, testing::IsEmpty());
}

TEST(SpecularGlossiness, ADefaultDiffuseColourIsNoTint) {
  std::string text = document("", R"("pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]},)");
  text.insert(text.find(kQuoted), R"("KHR_materials_translucency":{"translucencyFactor":0.7},)");
  EXPECT_EQ(extension_of(upgraded(text)).dump(), R"({"diffuseTransmissionFactor":0.7})");
}

// Pointers of animations.

std::string animated(const std::string& pointer) {
  return R"("animations":[{"p":"/materials/0/)" + pointer + R"("}],)";
}

std::string pointer_after(const std::string& member, const std::string& legacy) {
  const std::string root = animated("extensions/" + kName + "/" + member);
  return upgraded(document(legacy, "", root)).json()["animations"][0]["p"];
}

TEST(SpecularGlossiness, PointersFollow) {
  EXPECT_EQ(pointer_after("diffuseFactor", R"("diffuseFactor":[1,1,1,1])"),
            "/materials/0/pbrMetallicRoughness/baseColorFactor");
  EXPECT_EQ(pointer_after("diffuseFactor", ""),
            "/materials/0/pbrMetallicRoughness/baseColorFactor");
  EXPECT_EQ(pointer_after("specularFactor", ""),
            "/materials/0/extensions/KHR_materials_specular/specularColorFactor");
  EXPECT_EQ(pointer_after("diffuseTexture/extensions/KHR_texture_transform/offset",
                          R"("diffuseTexture":{"index":0})"),
            "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/"
            "offset");
}

TEST(SpecularGlossiness, AnAnimationOfTheFallbackStandsInTheWay) {
  for (const char* member : {"baseColorFactor", "roughnessFactor",
                             "metallicRoughnessTexture/extensions/KHR_texture_transform/scale"}) {
    const std::string text =
        document("", "", animated(std::string("pbrMetallicRoughness/").append(member)));
    EXPECT_EQ(upgraded(text).text, text);
    EXPECT_THAT(upgraded(text).only().notes, Contains(HasSubstr("was not seen")));
  }
}

TEST(SpecularGlossiness, FaultsAreNotCarriedOver) {
  for (const char* legacy :
       {R"("diffuseFactor":[1,1,1])", R"("glossinessFactor":2)", R"("glossinessFactor":"1")",
        R"("specularFactor":[2,0,0])", R"("diffuseTexture":{"index":2})"}) {
    const std::string text = document(legacy);
    EXPECT_EQ(upgraded(text).text, text);
    EXPECT_EQ(upgraded(text).only().fate, UpgradeFate::impossible) << legacy;
  }
  const std::string text = document("", R"("pbrMetallicRoughness":7,)");
  EXPECT_EQ(upgraded(text).text, text);
}

}  // namespace
}  // namespace gltfx::upgrade::test
