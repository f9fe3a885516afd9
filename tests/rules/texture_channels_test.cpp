// SPDX-License-Identifier: Apache-2.0
// Channels that slots read, compared with the channels of images, using only headers.
#include <string>

#include <gtest/gtest.h>

#include "image/ktx2_builder.hpp"
#include "rules/textured.hpp"

namespace gltfx::test {
namespace {

// --- Alpha that is data ---

const std::string kSheen = "/materials/0/extensions/KHR_materials_sheen/sheenRoughnessTexture";

Textured sheen(const std::string& image) {
  return {extension("KHR_materials_sheen",
                    R"("sheenColorFactor": [1, 1, 1], "sheenRoughnessFactor": 1,
                       "sheenRoughnessTexture": {"index": 0})"),
          {image},
          {},
          R"("KHR_materials_sheen")"};
}

TEST(TextureAlpha, ImagesWithoutItDoNothingInASlotThatReadsIt) {
  const Lines missing{"TEXTURE_ALPHA_MISSING " + kSheen};
  EXPECT_EQ(about_textures(sheen(rgb_png())), missing);
  EXPECT_EQ(about_textures(sheen(grey_png())), missing);
  EXPECT_EQ(about_textures(sheen(jpeg_header())), missing);
  EXPECT_EQ(about_textures(sheen(palette_png("\1\2\3"))), missing);
  EXPECT_EQ(about_textures(sheen(palette_png("\1\2\3", "\xFF"))), missing) << "opaque entries";
}

TEST(TextureAlpha, ImagesWithItAreSilent) {
  EXPECT_EQ(about_textures(sheen(rgba_png())), Lines{});
  EXPECT_EQ(about_textures(sheen(palette_png("\1\2\3", "\x7F"))), Lines{});
  EXPECT_EQ(about_textures(sheen(encode_png({1, 1, PngColor::grey_alpha, 8, "\x80\x40", {}}))),
            Lines{});
  const std::string key = png_encoder::chunk("tRNS", std::string(6, '\1'));
  EXPECT_EQ(about_textures(sheen(encode_png({1, 1, PngColor::rgb, 8, "\1\2\3", key}))), Lines{})
      << "a transparent colour";
}

TEST(TextureAlpha, WebpTellsItByItsHeader) {
  const auto shown = [](bool alpha) {
    Textured textured = sheen(webp_header(alpha));
    textured.textures = R"({"extensions": {"EXT_texture_webp": {"source": 0}}})";
    textured.extensions += R"(, "EXT_texture_webp"], "extensionsRequired": ["EXT_texture_webp")";
    return about_textures(textured);
  };
  EXPECT_EQ(shown(true), Lines{});
  EXPECT_EQ(shown(false), Lines{"TEXTURE_ALPHA_MISSING " + kSheen});
}

TEST(TextureAlpha, OneFindingForAllImagesThatATextureMayShow) {
  Textured textured = sheen(rgb_png());
  textured.images.push_back(webp_header(false));
  textured.textures = R"({"source": 0, "extensions": {"EXT_texture_webp": {"source": 1}}})";
  textured.extensions += R"(, "EXT_texture_webp")";
  EXPECT_EQ(about_textures(textured), Lines{"TEXTURE_ALPHA_MISSING " + kSheen});
}

TEST(TextureAlpha, TheImageIsNamed) {
  const std::string text = sheen(jpeg_header()).text();
  EXPECT_EQ(message(text, "TEXTURE_ALPHA_MISSING"),
            "sheenRoughnessTexture reads A, but image 0 is a JPEG, which has no alpha, so alpha is "
            "1 and the texture has no effect.");
}

TEST(TextureAlpha, GlossinessLiesBesideAColour) {
  const auto gloss = [](const std::string& image, const std::string& factors) {
    return about_textures({extension("KHR_materials_pbrSpecularGlossiness",
                                     factors + R"("specularGlossinessTexture": {"index": 0})"),
                           {image},
                           {},
                           R"("KHR_materials_pbrSpecularGlossiness")"});
  };
  const std::string slot =
      "/materials/0/extensions/KHR_materials_pbrSpecularGlossiness/specularGlossinessTexture";
  EXPECT_EQ(gloss(rgb_png(), ""), Lines{"TEXTURE_ALPHA_MISSING " + slot});
  EXPECT_EQ(gloss(rgba_png(), ""), Lines{});
  EXPECT_EQ(gloss(rgb_png(), R"("glossinessFactor": 0, )"), Lines{}) << "it has no visible effect";
}

// --- Translucency maps ---

const std::string kDiffuse =
    "/materials/0/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionTexture";

Textured diffuse(const std::string& image) {
  return {extension("KHR_materials_diffuse_transmission",
                    R"("diffuseTransmissionFactor": 1,
                       "diffuseTransmissionTexture": {"index": 0})",
                    R"("pbrMetallicRoughness": {"metallicFactor": 0}, )"),
          {image},
          {},
          R"("KHR_materials_diffuse_transmission")"};
}

TEST(Translucency, GreyMapsLeftInRedAreNamedAsSuch) {
  const Lines left{"TEXTURE_TRANSLUCENCY_IN_RED " + kDiffuse};
  EXPECT_EQ(about_textures(diffuse(grey_png())), left);
  EXPECT_EQ(about_textures(diffuse(jpeg_header(1))), left);
  EXPECT_EQ(about_textures(diffuse(palette_png("\1\1\1\2\2\2"))), left);
  EXPECT_NE(help(diffuse(grey_png()).text(), "TEXTURE_TRANSLUCENCY_IN_RED").find("gltfx upgrade"),
            std::string::npos);
}

TEST(Translucency, MapsOfColoursOnlyLackAlpha) {
  EXPECT_EQ(about_textures(diffuse(rgb_png())), Lines{"TEXTURE_ALPHA_MISSING " + kDiffuse});
  EXPECT_EQ(about_textures(diffuse(jpeg_header())), Lines{"TEXTURE_ALPHA_MISSING " + kDiffuse});
  EXPECT_EQ(about_textures(diffuse(rgba_png())), Lines{});
}

TEST(Translucency, TheFirstGenerationReadRed) {
  const auto legacy = [](const std::string& more) {
    return about_textures({extension("KHR_materials_translucency",
                                     R"("translucencyFactor": 1,
                                        "translucencyTexture": {"index": 0})" +
                                         more),
                           {grey_png()},
                           {},
                           R"("KHR_materials_translucency")"});
  };
  EXPECT_EQ(legacy(""), Lines{});
  EXPECT_EQ(legacy(R"(, "translucencyColorFactor": [1, 1, 1])"),
            Lines{"TEXTURE_ALPHA_MISSING /materials/0/extensions/KHR_materials_translucency/"
                  "translucencyTexture"});
}

// --- Gray images ---

TEST(GreyImages, CannotHoldTwoThings) {
  const auto packed = [](const std::string& image, const std::string& factors = {}) {
    return about_textures(
        {R"("pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0})" + factors + "}",
         {image}});
  };
  const Lines equal{
      "TEXTURE_CHANNELS_EQUAL /materials/0/pbrMetallicRoughness/metallicRoughnessTexture"};
  EXPECT_EQ(packed(grey_png()), equal);
  EXPECT_EQ(packed(jpeg_header(1)), equal);
  EXPECT_EQ(packed(rgb_png()), Lines{});
  EXPECT_EQ(packed(grey_png(), R"(, "metallicFactor": 0)"), Lines{}) << "only roughness is seen";
  EXPECT_EQ(packed(grey_png(), R"(, "roughnessFactor": 0)"), Lines{});
}

TEST(GreyImages, AreNoNormalMaps) {
  EXPECT_EQ(about_textures({R"("normalTexture": {"index": 0})", {grey_png()}}),
            Lines{"TEXTURE_CHANNELS_EQUAL /materials/0/normalTexture"});
  EXPECT_EQ(about_textures({R"("normalTexture": {"index": 0})", {rgb_png()}}), Lines{});
}

TEST(GreyImages, DoForOneChannelAndForColours) {
  EXPECT_EQ(about_textures({R"("occlusionTexture": {"index": 0})", {grey_png()}}), Lines{});
  EXPECT_EQ(about_textures({base_color(), {grey_png()}}), Lines{});
  EXPECT_EQ(about_textures({extension("KHR_materials_clearcoat",
                                      R"("clearcoatFactor": 1,
                                         "clearcoatRoughnessFactor": 1,
                                         "clearcoatRoughnessTexture": {"index": 0})"),
                            {grey_png()},
                            {},
                            R"("KHR_materials_clearcoat")"}),
            Lines{});
}

// --- Factors of 0 ---

Lines emissive(const std::string& more) {
  return about_textures({R"("emissiveTexture": {"index": 0})" + more, {rgb_png()}});
}

TEST(FactorZero, HidesATexture) {
  const Lines hidden{"TEXTURE_FACTOR_ZERO /materials/0/emissiveTexture"};
  EXPECT_EQ(emissive(""), hidden) << "black by default";
  EXPECT_EQ(emissive(R"(, "emissiveFactor": [0, 0, 0])"), hidden);
  EXPECT_EQ(emissive(R"(, "emissiveFactor": [0, 0, 0.1])"), Lines{});
}

TEST(FactorZero, OfASlotItself) {
  EXPECT_EQ(about_textures({R"("normalTexture": {"index": 0, "scale": 0})", {rgb_png()}}),
            Lines{"TEXTURE_FACTOR_ZERO /materials/0/normalTexture"});
  EXPECT_EQ(about_textures({R"("occlusionTexture": {"index": 0, "strength": 0})", {rgb_png()}}),
            Lines{"TEXTURE_FACTOR_ZERO /materials/0/occlusionTexture"});
}

TEST(FactorZero, OfBothChannels) {
  EXPECT_EQ(
      about_textures({R"("pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0},
                                "metallicFactor": 0, "roughnessFactor": 0})",
                      {rgb_png()}}),
      Lines{"TEXTURE_FACTOR_ZERO /materials/0/pbrMetallicRoughness/metallicRoughnessTexture"});
}

TEST(FactorZero, ALobeThatIsOffIsToldOnce) {
  const auto clearcoat = [](const std::string& members) {
    return about_textures({extension("KHR_materials_clearcoat", members),
                           {rgb_png()},
                           {},
                           R"("KHR_materials_clearcoat")"});
  };
  const std::string textures = R"("clearcoatTexture": {"index": 0},
      "clearcoatRoughnessTexture": {"index": 0}, "clearcoatRoughnessFactor": 1)";
  EXPECT_EQ(clearcoat(textures), Lines{"TEXTURE_FACTOR_ZERO /materials/0/extensions/"
                                       "KHR_materials_clearcoat/clearcoatTexture"});
  EXPECT_EQ(clearcoat(R"("clearcoatFactor": 1, )" + textures), Lines{});
}

TEST(FactorZero, BesideAMisspeltMemberIsNotKnown) {
  const auto sheen_with = [](const std::string& factor) {
    const Textured textured{extension("KHR_materials_sheen",
                                      factor + R"(: [1, 1, 1], "sheenColorTexture": {"index": 0})"),
                            {rgb_png()},
                            {},
                            R"("KHR_materials_sheen")"};
    return selected(textured.text(), {"TEXTURE_FACTOR_ZERO"}).size();
  };
  EXPECT_EQ(sheen_with(R"("sheenColourFactor")"), 0U);
  EXPECT_EQ(sheen_with(R"("extras")"), 1U);
}

TEST(FactorZero, ThatIsAnimatedIsNone) {
  const std::string animation = R"(, "animations": [{"channels": [{"sampler": 0, "target": {
      "path": "pointer", "extensions": {"KHR_animation_pointer": {
      "pointer": "/materials/0/emissiveFactor"}}}}], "samplers": []}])";
  const Textured textured{R"("emissiveTexture": {"index": 0})",
                          {rgb_png()},
                          {},
                          R"("KHR_animation_pointer")",
                          animation};
  EXPECT_EQ(selected(textured.text(), {"TEXTURE_FACTOR_ZERO"}), Lines{});
}

TEST(FactorZero, SpecularColoursDoNotHideDiffuseOnes) {
  EXPECT_EQ(about_textures({extension("KHR_materials_pbrSpecularGlossiness",
                                      R"("specularFactor": [0, 0, 0],
                                         "diffuseTexture": {"index": 0})"),
                            {rgb_png()},
                            {},
                            R"("KHR_materials_pbrSpecularGlossiness")"}),
            Lines{});
}

// --- Coverage ---

const std::string kBase = "/materials/0/pbrMetallicRoughness/baseColorTexture";

TEST(Coverage, NeedsAnAlpha) {
  const Lines missing{"MATERIAL_ALPHA_MISSING " + kBase};
  for (const char* mode : {"MASK", "BLEND"}) {
    const std::string member = std::string(R"(, "alphaMode": ")") + mode + '"';
    EXPECT_EQ(about_textures({base_color(member), {rgb_png()}}), missing) << mode;
    EXPECT_EQ(about_textures({base_color(member), {jpeg_header()}}), missing) << mode;
    EXPECT_EQ(about_textures({base_color(member), {rgba_png()}}), Lines{}) << mode;
  }
  EXPECT_EQ(about_textures({base_color(), {rgb_png()}}), Lines{});
}

TEST(Coverage, MayComeFromTheFactor) {
  EXPECT_EQ(about_textures({R"("alphaMode": "BLEND", "pbrMetallicRoughness": {
                                "baseColorFactor": [1, 1, 1, 0.5],
                                "baseColorTexture": {"index": 0}})",
                            {rgb_png()}}),
            Lines{});
}

TEST(Coverage, MayComeFromVertices) {
  const auto colored = [](const std::string& type) {
    const Textured textured{base_color(R"(, "alphaMode": "BLEND")"),
                            {rgb_png()},
                            {},
                            {},
                            R"(, "meshes": [{"primitives": [{"attributes": {"COLOR_0": 0},
                                "material": 0}]}], "accessors": [{"componentType": 5126,
                                "count": 1, "type": ")" +
                                type + R"("}])"};
    return selected(textured.text(), {"MATERIAL_ALPHA_MISSING"});
  };
  EXPECT_EQ(colored("VEC4"), Lines{});
  EXPECT_EQ(colored("VEC3"), Lines{"MATERIAL_ALPHA_MISSING " + kBase});
}

TEST(Coverage, AlphaThatNobodyReadsIsAHint) {
  EXPECT_EQ(about_textures({base_color(), {rgba_png()}}), Lines{});
  EXPECT_EQ(about_textures({base_color(), {rgba_png()}}, Profile::strict),
            Lines{"TEXTURE_ALPHA_UNUSED " + kBase});
  EXPECT_EQ(about_textures({base_color(R"(, "alphaMode": "MASK")"), {rgba_png()}}, Profile::strict),
            Lines{});
}

TEST(Coverage, AlphaThatAnotherSlotReadsIsUsed) {
  const Textured textured{
      base_color(extension("KHR_materials_specular", R"("specularTexture": {"index": 0})", ", ")),
      {rgba_png()},
      {},
      R"("KHR_materials_specular")"};
  EXPECT_EQ(about_textures(textured, Profile::strict), Lines{});
}

// --- No findings ---

TEST(TextureSlots, BrokenReferencesAreNotJudgedTwice) {
  EXPECT_EQ(about_textures({R"("emissiveTexture": {"index": 7})", {rgb_png()}}),
            Lines{"UNRESOLVED_REFERENCE /materials/0/emissiveTexture/index"});
  EXPECT_EQ(about_textures({R"("emissiveTexture": {"index": 0})", {rgb_png()}, "{}"}), Lines{});
}

TEST(TextureSlots, HeadersInDoubtAreNotJudgedTwice) {
  const std::string doubtful = png({}, {4, 4, 3, 2, 0});
  EXPECT_EQ(about_textures(sheen(doubtful)), Lines{"IMAGE_DATA_INVALID /images/0"});
}

TEST(TextureSlots, TheKhronosProfileKnowsNoneOfThis) {
  EXPECT_EQ(selected(sheen(rgb_png()).text(), {"TEXTURE_ALPHA_MISSING"}, Profile::khronos),
            Lines{});
}

TEST(TextureSlots, RepeatsAreFolded) {
  const std::string one = R"({"emissiveTexture": {"index": 0}})";
  EXPECT_EQ(about_textures({one + ", " + one + ", " + one, {rgb_png()}}),
            Lines{"TEXTURE_FACTOR_ZERO /materials/0/emissiveTexture x3"});
}

}  // namespace
}  // namespace gltfx::test
