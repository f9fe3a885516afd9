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

// A document with one material: members of the material, of the legacy object, and of the root.
std::string glossy_document(const std::string& legacy, const std::string& material = "",
                            const std::string& root = "") {
  return R"({"extensionsUsed":[")" + kName + R"("],"textures":[{},{}],)" + root +
         R"("materials":[{)" + material + R"("extensions":{")" + kName + R"(":{)" + legacy +
         "}}}]}";
}

Json material_after(const std::string& legacy, const std::string& material = "") {
  return upgraded(glossy_document(legacy, material)).json()["materials"][0];
}

TEST(SpecularGlossiness, FactorsAndTexturesGoWhereTheyAreReadToday) {
  const Upgraded result = upgraded(glossy_document(
      R"("diffuseFactor":[0.50,0.8,0.2,1e0],"diffuseTexture":{"index":1,"texCoord":1},)"
      R"("specularFactor":[1,0.766,0.336],"glossinessFactor":0.9)"));
  EXPECT_EQ(result.json()["materials"][0].dump(),
            R"({"extensions":{"KHR_materials_specular":{"specularColorFactor":[1,0.766,0.336]},)"
            R"("KHR_materials_ior":{"ior":0}},"pbrMetallicRoughness":)"
            R"({"baseColorFactor":[0.5,0.8,0.2,1.0],"baseColorTexture":{"index":1,"texCoord":1},)"
            R"("metallicFactor":0,"roughnessFactor":0.1}})");
  EXPECT_THAT(result.text, HasSubstr("[0.50,0.8,0.2,1e0]"));  // numbers keep their spelling
  EXPECT_THAT(result.json()["extensionsUsed"],
              ElementsAre("KHR_materials_specular", "KHR_materials_ior"));
  EXPECT_EQ(result.only().outcome, UpgradeOutcome::safe);
  EXPECT_FALSE(result.only().lossy);
}

TEST(SpecularGlossiness, DefaultsAreThoseOfTheOldModel) {
  EXPECT_EQ(material_after("").dump(),
            R"({"extensions":{"KHR_materials_specular":{},"KHR_materials_ior":{"ior":0}},)"
            R"("pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0}})");
}

TEST(SpecularGlossiness, RoughnessIsADecimalNumber) {
  const auto roughness = [](const std::string& glossiness) {
    const std::string text = upgraded(glossy_document(R"("glossinessFactor":)" + glossiness)).text;
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
  const Upgraded result = upgraded(glossy_document(
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
      upgraded(glossy_document("", "", R"("extensionsRequired":[")" + kName + R"("],)")).json();
  EXPECT_THAT(root["extensionsRequired"],
              ElementsAre("KHR_materials_specular", "KHR_materials_ior"));
}

TEST(SpecularGlossiness, AnotherIndexOfRefractionIsALoss) {
  UpgradeOptions options;
  options.ior = 1000;
  const Upgraded result = upgraded(glossy_document(""), options);
  EXPECT_EQ(result.json()["materials"][0]["extensions"]["KHR_materials_ior"].dump(),
            R"({"ior":1000})");
  EXPECT_TRUE(result.only().done);
  EXPECT_TRUE(result.only().lossy);
}

TEST(SpecularGlossiness, WhatItMustNotStandBesideIsSeenAfterwards) {
  std::string text = glossy_document("");
  text.insert(text.find(kQuoted), R"("KHR_materials_clearcoat":{},)");
  EXPECT_EQ(upgraded(text).text, text);
  EXPECT_EQ(upgraded(text).only().outcome, UpgradeOutcome::unsafe);
  UpgradeOptions unsafe;
  unsafe.unsafe = true;
  EXPECT_TRUE(upgraded(text, unsafe).only().done);
}

TEST(SpecularGlossiness, BesideWhatTheSuccessorWouldBreakItStays) {
  for (const std::string other :
       {"KHR_materials_volume", "KHR_materials_specular", "KHR_materials_ior"}) {
    std::string text = glossy_document("");
    text.insert(text.find(kQuoted), std::string("\"").append(other).append("\":{},"));
    UpgradeOptions unsafe;
    unsafe.unsafe = true;
    const Upgraded result = upgraded(text, unsafe);
    EXPECT_EQ(result.text, text);
    EXPECT_EQ(result.only().outcome, UpgradeOutcome::impossible);
    EXPECT_THAT(result.only().notes, Contains(HasSubstr(other)));
  }
}

// The specifications do not define which of two models of the whole material counts; most readers
// use unlit.
Upgraded beside_unlit(const std::string& legacy, const std::string& material, bool unsafe) {
  std::string text = glossy_document(legacy, material);
  text.insert(text.find(kQuoted), R"("KHR_materials_unlit":{},)");
  UpgradeOptions options;
  options.unsafe = unsafe;
  Upgraded result = upgraded(text, options);
  EXPECT_EQ(result.text == text, !unsafe);
  EXPECT_EQ(result.only().outcome, UpgradeOutcome::unsafe);
  EXPECT_THAT(result.only().notes,
              Contains("no effect: unlit materials have no specular-glossiness"));
  return result;
}

TEST(SpecularGlossiness, BesideUnlitItGoesWhenAskedForAndLeavesItsColour) {
  const std::string legacy =
      R"("diffuseFactor":[1,0,0,1],"diffuseTexture":{"index":1},"glossinessFactor":0.5)";
  beside_unlit(legacy, "", false);
  const Upgraded done = beside_unlit(legacy, "", true);
  EXPECT_EQ(done.json()["materials"][0].dump(),
            R"({"extensions":{"KHR_materials_unlit":{}},"pbrMetallicRoughness":)"
            R"({"baseColorFactor":[1,0,0,1],"baseColorTexture":{"index":1}}})");
  EXPECT_TRUE(done.only().removed);
  EXPECT_THAT(done.only().notes,
              Contains("diffuseFactor becomes pbrMetallicRoughness/baseColorFactor"));
  EXPECT_THAT(upgraded(done.text).plan.actions, testing::IsEmpty());
}

TEST(SpecularGlossiness, BesideUnlitABaseColourThatIsThereStays) {
  const std::string base = R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}},)";
  const Upgraded done = beside_unlit(R"("diffuseFactor":[1,0,0,1])", base, true);
  EXPECT_EQ(done.json()["materials"][0].dump(),
            R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},)"
            R"("extensions":{"KHR_materials_unlit":{}}})");
}

TEST(SpecularGlossiness, TranslucencyBesideItTakesItsDiffuseColour) {
  std::string text =
      glossy_document(R"("diffuseFactor":[0.5,0.8,0.2,1],"diffuseTexture":{"index":1})",
                      R"("pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]},)");
  text.insert(text.find(kQuoted), R"("KHR_materials_translucency":{"translucencyFactor":0.7},)");
  const Upgraded result = upgraded(text);
  EXPECT_EQ(extension_of(result).dump(),
            R"({"diffuseTransmissionFactor":0.7,"diffuseTransmissionColorFactor":[0.5,0.8,0.2],)"
            R"("diffuseTransmissionColorTexture":{"index":1}})");
  EXPECT_THAT(upgraded(result.text).plan.actions, testing::IsEmpty());
}

TEST(SpecularGlossiness, ADefaultDiffuseColourIsNoTint) {
  std::string text =
      glossy_document("", R"("pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]},)");
  text.insert(text.find(kQuoted), R"("KHR_materials_translucency":{"translucencyFactor":0.7},)");
  EXPECT_EQ(extension_of(upgraded(text)).dump(), R"({"diffuseTransmissionFactor":0.7})");
}

// Textures.

// One RGBA image whose alpha has these least and greatest values.
class OneImage : public Pictures {
 public:
  OneImage(std::uint32_t least, std::uint32_t greatest) {
    picture_.image.width = picture_.image.height = 4;
    picture_.image.channels = 4;
    picture_.image.statistics = {};
    picture_.image.statistics[3] = {least, greatest, 0, 0};
  }
  const Picture& picture(std::uint64_t image) override { return image == 0 ? picture_ : none_; }
  std::shared_ptr<const codec::Image> pixels(std::uint64_t) override { return nullptr; }
  std::uint64_t same_as(std::uint64_t image) override { return image; }

 private:
  Picture picture_;
  Picture none_{"it is not there", {}, false};
};

const std::string kTextures = R"("samplers":[{}],"images":[{}],)";

std::string textured(const std::string& legacy, const std::string& root = "") {
  std::string text = glossy_document(
      R"("specularGlossinessTexture":{"index":1,"texCoord":1,"extras":{"index":1}})" + legacy, "",
      kTextures + root);
  const std::string plain = R"("textures":[{},{}])";
  return text.replace(text.find(plain), plain.size(),
                      R"("textures":[{},{"sampler":0,"source":0}])");
}

TEST(SpecularGlossiness, GlossinessInAlphaBecomesRoughnessInGreen) {
  OneImage image(3, 200);
  const Upgraded result = upgraded(textured(R"(,"glossinessFactor":0.5)"), {}, &image);
  EXPECT_EQ(result.json()["materials"][0].dump(),
            R"({"extensions":{"KHR_materials_specular":{"specularColorTexture":)"
            R"({"index":1,"texCoord":1,"extras":{"index":1}}},"KHR_materials_ior":{"ior":0}},)"
            R"("pbrMetallicRoughness":{"metallicFactor":0,"metallicRoughnessTexture":)"
            R"({"index":2,"texCoord":1,"extras":{"index":1}},"roughnessFactor":1}})");
  const change::Additions& made = result.plan.change.additions;
  EXPECT_EQ(made.elements().at("textures"),
            std::vector<std::string>{R"({"sampler":0,"source":1})"});
  ASSERT_EQ(made.images().size(), 1U);
  const ImageJob wanted{{ChannelSource::constant(1), ChannelSource::of(0, 3, -0.5, 1),
                         ChannelSource::constant(0), ChannelSource::constant(1)}};
  EXPECT_EQ(result.plan.images.at(0), wanted);
}

TEST(SpecularGlossiness, OneGlossinessForAllTexelsIsAFactor) {
  const auto material = [](const std::string& legacy, std::uint32_t alpha) {
    OneImage image(alpha, alpha);
    const Upgraded result = upgraded(textured(legacy), {}, &image);
    EXPECT_TRUE(result.plan.change.additions.empty());
    return result.json()["materials"][0]["pbrMetallicRoughness"].dump();
  };
  EXPECT_EQ(material(R"(,"glossinessFactor":0.5)", 255),
            R"({"metallicFactor":0,"roughnessFactor":0.5})");
  EXPECT_EQ(material(R"(,"glossinessFactor":0.5)", 51),
            R"({"metallicFactor":0,"roughnessFactor":0.9})");
  EXPECT_EQ(material("", 0), R"({"metallicFactor":0,"roughnessFactor":1})");
}

TEST(SpecularGlossiness, WithoutGlossinessTheTextureNeedNotBeRead) {
  EXPECT_EQ(upgraded(textured(R"(,"glossinessFactor":0)"))
                .json()["materials"][0]["pbrMetallicRoughness"]
                .dump(),
            R"({"metallicFactor":0,"roughnessFactor":1})");
}

TEST(SpecularGlossiness, ATextureThatCannotBeReadKeepsTheMaterial) {
  const std::string text = textured("");
  EXPECT_EQ(upgraded(text).text, text);
  EXPECT_EQ(upgraded(text).only().outcome, UpgradeOutcome::needs_image);
  OneImage image(0, 255);
  const std::string without = glossy_document(R"("specularGlossinessTexture":{"index":0})");
  const Upgraded result = upgraded(without, {}, &image);
  EXPECT_EQ(result.text, without);
  EXPECT_THAT(result.only().notes, Contains(HasSubstr("no image")));
}

TEST(SpecularGlossiness, AnAnimatedTransformWouldDriveTwoTextures) {
  const std::string text =
      textured("", animated("/materials/0/extensions/KHR_materials_pbrSpecularGlossiness/"
                            "specularGlossinessTexture/extensions/KHR_texture_transform/offset"));
  OneImage varied(0, 255);
  const Upgraded left = upgraded(text, {}, &varied);
  EXPECT_EQ(left.only().outcome, UpgradeOutcome::impossible);
  EXPECT_TRUE(left.plan.change.additions.empty());
  OneImage even(255, 255);
  EXPECT_EQ(pointer_of(upgraded(text, {}, &even).json()),
            "/materials/0/extensions/KHR_materials_specular/specularColorTexture/extensions/"
            "KHR_texture_transform/offset");
}

// Pointers of animations.

std::string animated_gloss(const std::string& pointer) {
  return animated("/materials/0/" + pointer);
}

std::string gloss_pointer_after(const std::string& member, const std::string& legacy) {
  const std::string root = animated_gloss("extensions/" + kName + "/" + member);
  return pointer_of(upgraded(glossy_document(legacy, "", root)).json());
}

TEST(SpecularGlossiness, PointersFollow) {
  EXPECT_EQ(gloss_pointer_after("diffuseFactor", R"("diffuseFactor":[1,1,1,1])"),
            "/materials/0/pbrMetallicRoughness/baseColorFactor");
  EXPECT_EQ(gloss_pointer_after("diffuseFactor", ""),
            "/materials/0/pbrMetallicRoughness/baseColorFactor");
  EXPECT_EQ(gloss_pointer_after("specularFactor", ""),
            "/materials/0/extensions/KHR_materials_specular/specularColorFactor");
  EXPECT_EQ(gloss_pointer_after("diffuseTexture/extensions/KHR_texture_transform/offset",
                                R"("diffuseTexture":{"index":0})"),
            "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/"
            "offset");
}

TEST(SpecularGlossiness, AnAnimatedGlossinessIsLeftAlone) {
  const std::string text =
      glossy_document("", "", animated_gloss("extensions/" + kName + "/glossinessFactor"));
  EXPECT_EQ(upgraded(text).text, text);
  EXPECT_THAT(upgraded(text).only().notes, Contains(HasSubstr("glossinessFactor is animated")));
}

TEST(SpecularGlossiness, AnAnimationOfTheFallbackStandsInTheWay) {
  for (const char* member : {"baseColorFactor", "roughnessFactor",
                             "metallicRoughnessTexture/extensions/KHR_texture_transform/scale"}) {
    const std::string text = glossy_document(
        "", "", animated_gloss(std::string("pbrMetallicRoughness/").append(member)));
    EXPECT_EQ(upgraded(text).text, text);
    EXPECT_THAT(upgraded(text).only().notes, Contains(HasSubstr("no effect before")));
  }
}

TEST(SpecularGlossiness, ErrorsAreNotCarriedOver) {
  for (const char* legacy :
       {R"("diffuseFactor":[1,1,1])", R"("glossinessFactor":2)", R"("glossinessFactor":"1")",
        R"("specularFactor":[2,0,0])", R"("diffuseTexture":{"index":2})"}) {
    const std::string text = glossy_document(legacy);
    EXPECT_EQ(upgraded(text).text, text);
    EXPECT_EQ(upgraded(text).only().outcome, UpgradeOutcome::impossible) << legacy;
  }
  const std::string text = glossy_document("", R"("pbrMetallicRoughness":7,)");
  EXPECT_EQ(upgraded(text).text, text);
}

}  // namespace
}  // namespace gltfx::upgrade::test
