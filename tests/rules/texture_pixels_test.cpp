// SPDX-License-Identifier: Apache-2.0
// Findings on decoded pixels, and that only requested images are decoded.
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "codec/support/jpeg_bytes.hpp"
#include "container/base64.hpp"
#include "rules/payload/texture_phase.hpp"
#include "rules/textured.hpp"

namespace gltfx::test {
namespace {

Lines needed(const Textured& textured, Profile profile = Profile::standard) {
  return about_textures(textured, profile, PixelLevel::needed);
}

// Hints of one code.
Lines hints(const Textured& textured, const std::string& code) {
  ValidateOptions options;
  options.select = {code};
  options.pixels = PixelLevel::needed;
  return verdict(textured.text(), options);
}

std::string broken_png() {
  std::string bytes = rgb_png("\1\2\3\4\5\6");
  return bytes.replace(bytes.find("IDAT") + 6, 4,
                       "....");  // after the part that header checks read
}

const std::string kBasePixels = "/materials/0/pbrMetallicRoughness/baseColorTexture";

// --- Levels ---

TEST(PixelLevels, AreHeadersUnlessAskedFor) {
  ValidateOptions options;
  EXPECT_EQ(pixel_level(options), PixelLevel::headers);
  options.profile = Profile::strict;
  EXPECT_EQ(pixel_level(options), PixelLevel::needed);
  options.pixels = PixelLevel::headers;
  EXPECT_EQ(pixel_level(options), PixelLevel::headers) << "what is said counts";
  options.profile = Profile::khronos;
  options.pixels = PixelLevel::all;
  EXPECT_EQ(pixel_level(options), PixelLevel::headers) << "as that validator does it";
}

TEST(PixelLevels, OnlyWhatARuleNeedsIsDecoded) {
  const Textured textured{extension("KHR_materials_clearcoat",
                                    R"("clearcoatFactor": 1, "clearcoatTexture": {"index": 0})"),
                          {broken_png()},
                          {},
                          R"("KHR_materials_clearcoat")"};
  EXPECT_EQ(about_textures(textured), Lines{});
  EXPECT_EQ(needed(textured), Lines{}) << "no rule of this profile looks at a clearcoat";
  EXPECT_EQ(needed({base_color(R"(, "alphaMode": "MASK")"), {rgba_png()}}), Lines{});
  EXPECT_EQ(about_textures(textured, Profile::standard, PixelLevel::all),
            Lines{"IMAGE_PIXELS_INVALID /images/0"});
  EXPECT_EQ(needed(textured, Profile::strict), Lines{"IMAGE_PIXELS_INVALID /images/0"});
}

TEST(PixelLevels, AnImageThatEndsTooEarlyIsAWarning) {
  std::string bytes = *container::decode_base64(kJpegBase64);
  const auto severity = [](const std::string& image) {
    ValidateOptions options;
    options.pixels = PixelLevel::all;
    options.select = {"IMAGE_PIXELS_INVALID"};
    const auto report = validate_bytes(Textured{base_color(), {image}}.text(), "test", options);
    return report.diagnostics.empty() ? Severity::hint : report.diagnostics[0].severity;
  };
  EXPECT_EQ(severity(bytes), Severity::hint) << "nothing is said";
  bytes.resize(bytes.size() - 6);
  EXPECT_EQ(severity(bytes), Severity::warning) << "the rest is shown";
  EXPECT_EQ(severity(broken_png()), Severity::error);
}

TEST(PixelLevels, AllIncludesImagesThatNobodyShows) {
  const Textured textured{base_color(), {rgb_png(), broken_png()}, R"({"source": 0})"};
  EXPECT_EQ(about_textures(textured, Profile::standard, PixelLevel::all),
            Lines{"IMAGE_PIXELS_INVALID /images/1"});
}

TEST(PixelLevels, ImagesThatAreTooLargeAreLeftOut) {
  const std::string huge = encode_png({65535, 65535, PngColor::rgb, 8, {}, {}});
  EXPECT_EQ(about_textures({base_color(), {huge}}, Profile::standard, PixelLevel::all),
            Lines{"IMAGE_NOT_DECODED /images/0"});
}

TEST(PixelLevels, ManyImagesEndSomewhere) {
  model::ResourceData resources;
  for (int i = 0; i < 3; ++i) {
    model::ImageData image;
    image.bytes = container::Bytes::from_string(rgb_png());
    image.header = std::get<image::Header>(image::read_header(image.bytes->view()));
    resources.images.push_back(image);
  }
  validate::PixelSource pixels(resources, 2);
  pixels.decode({{0, false}, {2, false}, {1, false}}, 2);
  EXPECT_NE(pixels.of(0), nullptr);
  EXPECT_NE(pixels.of(2), nullptr);
  ASSERT_NE(pixels.error(1), nullptr);
  EXPECT_EQ(pixels.error(1)->kind, codec::ErrorKind::too_large);
}

// --- Constant channels ---

TEST(ConstantTextures, AreAHint) {
  const Lines hint{"TEXTURE_CONSTANT " + kBasePixels};
  EXPECT_EQ(hints({base_color(), {rgb_png("\1\2\3\1\2\3")}}, "TEXTURE_CONSTANT"), hint);
  EXPECT_EQ(hints({base_color(), {rgb_png("\1\2\3\1\2\4")}}, "TEXTURE_CONSTANT"), Lines{});
  EXPECT_EQ(hints({base_color(), {rgb_png("\1\2\3")}}, "TEXTURE_CONSTANT"), Lines{})
      << "one texel is meant to be";
}

TEST(ConstantTextures, OnlyChannelsThatAreReadCount) {
  const std::string occlusion = R"("occlusionTexture": {"index": 0})";
  EXPECT_EQ(hints({occlusion, {rgb_png("\1\2\3\1\5\6")}}, "TEXTURE_CONSTANT"),
            Lines{"TEXTURE_CONSTANT /materials/0/occlusionTexture"});
  EXPECT_EQ(hints({occlusion, {grey_png("\1\2")}}, "TEXTURE_CONSTANT"), Lines{});
}

Textured specular(const std::string& image) {
  return {extension("KHR_materials_specular", R"("specularTexture": {"index": 0})"),
          {image},
          {},
          R"("KHR_materials_specular")"};
}

TEST(ConstantAlpha, OfOneHasNoEffect) {
  const std::string at =
      "TEXTURE_ALPHA_CONSTANT /materials/0/extensions/KHR_materials_specular/specularTexture";
  EXPECT_EQ(needed(specular(rgba_png("\1\2\3\xFF\4\5\6\xFF"))), Lines{at});
  EXPECT_EQ(needed(specular(rgba_png("\1\2\3\xFF\4\5\6\xFE"))), Lines{});
  EXPECT_EQ(about_textures(specular(rgba_png("\1\2\3\xFF\4\5\6\xFF"))), Lines{}) << "headers";
}

TEST(ConstantAlpha, OfAnotherValueIsAHint) {
  const Textured textured = specular(rgba_png("\1\2\3\x40\4\5\6\x40"));
  EXPECT_EQ(needed(textured), Lines{});
  EXPECT_EQ(hints(textured, "TEXTURE_ALPHA_CONSTANT").size(), 1U);
}

TEST(ConstantAlpha, IsNoCoverage) {
  const std::string opaque = rgba_png("\1\2\3\xFF\4\5\6\xFF");
  const Lines missing{"MATERIAL_ALPHA_MISSING " + kBasePixels};
  EXPECT_EQ(needed({base_color(R"(, "alphaMode": "BLEND")"), {opaque}}), missing);
  EXPECT_EQ(needed({base_color(R"(, "alphaMode": "BLEND")"), {rgba_png("\1\2\3\xFF\4\5\6\x10")}}),
            Lines{})
      << "there are holes";
  EXPECT_EQ(hints({base_color(), {opaque}}, "TEXTURE_ALPHA_OPAQUE"),
            Lines{"TEXTURE_ALPHA_OPAQUE " + kBasePixels});
  EXPECT_EQ(hints({base_color(), {rgba_png("\1\2\3\xFF\4\5\6\x80")}}, "TEXTURE_ALPHA_OPAQUE"),
            Lines{});
}

// --- Cases that headers leave open ---

TEST(ColorSpacePixels, BlackAndWhiteAreTheSameInBoth) {
  const auto shared = [](const std::string& image) {
    return needed({base_color(R"(, "occlusionTexture": {"index": 0})"), {image}});
  };
  EXPECT_EQ(shared(rgb_png(std::string("\0\1\2\xFF\1\2", 6))), Lines{}) << "only R is read by both";
  EXPECT_EQ(shared(rgb_png(std::string("\0\0\0\xFF\xFF\xFF", 6))), Lines{});
  EXPECT_EQ(shared(grey_png(std::string("\0\xFF", 2))), Lines{});
  EXPECT_EQ(shared(grey_png("\x80\x81")).size(), 1U);
}

Textured diffuse_pixels(const std::string& image) {
  return {extension("KHR_materials_diffuse_transmission",
                    R"("diffuseTransmissionFactor": 1,
                       "diffuseTransmissionTexture": {"index": 0})",
                    R"("pbrMetallicRoughness": {"metallicFactor": 0}, )"),
          {image},
          {},
          R"("KHR_materials_diffuse_transmission")"};
}

TEST(TranslucencyPixels, GreyMapsInRgbAreNamedAsSuch) {
  const std::string at =
      " /materials/0/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionTexture";
  EXPECT_EQ(needed(diffuse_pixels(rgb_png("\1\1\1\2\2\2"))),
            Lines{"TEXTURE_TRANSLUCENCY_IN_RED" + at});
  EXPECT_EQ(needed(diffuse_pixels(rgb_png(std::string("\1\0\0\2\0\0", 6)))),
            Lines{"TEXTURE_TRANSLUCENCY_IN_RED" + at});
  EXPECT_EQ(needed(diffuse_pixels(rgb_png("\1\2\3\2\3\4"))), Lines{"TEXTURE_ALPHA_MISSING" + at});
  EXPECT_EQ(about_textures(diffuse_pixels(rgb_png("\1\1\1\2\2\2"))),
            Lines{"TEXTURE_ALPHA_MISSING" + at});
}

// --- Normal maps ---

Lines normals(const std::string& texels) {
  return needed({R"("normalTexture": {"index": 0})", {rgb_png(texels)}});
}
const std::string kSlot = " /materials/0/normalTexture";

TEST(NormalMaps, OfUnitLengthAreSilent) {
  EXPECT_EQ(normals("\x80\x80\xFF\xBC\x80\xEF"), Lines{});
  EXPECT_EQ(normals("\x80\x80\xFF\xBC\x80\xE0"), Lines{}) << "within what 8 bits and JPEG lose";
}

TEST(NormalMaps, OfOtherLengthsAreFound) {
  EXPECT_EQ(normals("\x80\x80\xB0\x8C\x80\x98"), Lines{"NORMAL_MAP_NOT_UNIT" + kSlot});
}

TEST(NormalMaps, ThatPointInwardAreFound) {
  EXPECT_EQ(normals(std::string("\x80\x80\x00\xBC\x80\x10", 6)),
            Lines{"NORMAL_MAP_INWARD" + kSlot});
}

TEST(NormalMaps, FewStrayTexelsDoNotCount) {
  std::string texels;
  for (int i = 0; i < 99; ++i) texels += i % 2 == 0 ? "\x80\x80\xFF" : "\xBC\x80\xEF";
  EXPECT_EQ(normals(texels + "\x80\x81\x82"), Lines{});
}

TEST(NormalMaps, GapsBetweenChartsDoNotCount) {
  std::string texels(300, '\0');
  EXPECT_EQ(normals(texels + "\x80\x80\xFF\xBC\x80\xEF"), Lines{});
}

std::string normal_message(const std::string& texels) {
  ValidateOptions options;
  options.pixels = PixelLevel::needed;
  options.select = {"NORMAL_MAP_INWARD", "NORMAL_MAP_NOT_UNIT", "TEXTURE_CHANNELS_EQUAL"};
  const Textured textured{R"("normalTexture": {"index": 0})", {rgb_png(texels)}};
  const FileReport report = validate_bytes(textured.text(), "test", options);
  return report.diagnostics.empty() ? std::string() : report.diagnostics[0].message;
}

TEST(NormalMaps, OfTwoChannelsWithoutBluePointInward) {
  const std::string empty("\x20\x80\x00\xBC\x10\x00", 6);
  EXPECT_EQ(normals(empty), Lines{"NORMAL_MAP_INWARD" + kSlot});
  EXPECT_NE(normal_message(empty).find("B of image 0 is 0 in every texel"), std::string::npos);
  EXPECT_EQ(normals(std::string("\x80\x80\x00\x7F\x80\x00", 6)), Lines{"NORMAL_MAP_INWARD" + kSlot})
      << "not even when they are flat";
}

TEST(NormalMaps, OfTwoChannelsWithFullBlueAreNotUnit) {
  const std::string full = "\x20\x80\xFF\xBC\x10\xFF";
  EXPECT_EQ(normals(full), Lines{"NORMAL_MAP_NOT_UNIT" + kSlot});
  EXPECT_NE(normal_message(full).find("B of image 0 is 255 in every texel"), std::string::npos);
  EXPECT_NE(normal_message("\x20\x80\xFA\xBC\x10\xFF").find("is 250 or more"), std::string::npos)
      << "as lossy coding leaves it";
  EXPECT_EQ(normals("\x88\x80\xFF\x78\x84\xFF"), Lines{}) << "gentle slopes round to that";
  EXPECT_EQ(normals("\x20\x80\x80\xBC\x10\x80"), Lines{}) << "of unit length, without Z";
  EXPECT_EQ(normals("\x60\x80\x80\x9C\x70\x80"), Lines{"NORMAL_MAP_NOT_UNIT" + kSlot})
      << "B of 128 everywhere";
}

TEST(NormalMaps, ThatAreHeightMapsInRgbAreFound) {
  EXPECT_EQ(normals("\x20\x20\x20\x90\x90\x90"), Lines{"TEXTURE_CHANNELS_EQUAL" + kSlot});
  EXPECT_NE(normal_message("\x20\x20\x20\x90\x90\x90").find("it may be a height map"),
            std::string::npos);
  EXPECT_EQ(normals("\x80\x80\x80"), Lines{"TEXTURE_CHANNELS_EQUAL" + kSlot}) << "no vector";
  EXPECT_EQ(normals("\x20\x20\x20\x90\x90\x91"), Lines{"NORMAL_MAP_NOT_UNIT" + kSlot})
      << "one texel has a colour";
  EXPECT_EQ(
      about_textures({R"("normalTexture": {"index": 0})", {rgb_png("\x20\x20\x20\x90\x90\x90")}}),
      Lines{})
      << "headers";
}

// --- Gray maps in RGB ---

const std::string kRough = R"("pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}%})";

Lines grey_data(const std::string& texels, const std::string& factors = {}) {
  std::string material = kRough;
  material.replace(material.find('%'), 1, factors);
  return needed({material, {rgb_png(texels)}});
}

TEST(GreyMaps, OfSeveralValuesAreFoundInData) {
  const Lines equal{
      "TEXTURE_CHANNELS_EQUAL /materials/0/pbrMetallicRoughness/metallicRoughnessTexture"};
  EXPECT_EQ(grey_data("\x20\x20\x20\x90\x90\x90"), equal);
  EXPECT_EQ(grey_data("\x20\x20\x20\x90\x91\x90"), Lines{});
  EXPECT_EQ(grey_data("\xFF\xFF\xFF\xFF\xFF\xFF"), Lines{}) << "factors alone";
  EXPECT_EQ(grey_data("\x20\x20\x20\x90\x90\x90", R"(, "metallicFactor": 0)"), Lines{})
      << "only roughness is read";
  EXPECT_EQ(needed({extension("KHR_materials_anisotropy",
                              R"("anisotropyStrength": 1, "anisotropyTexture": {"index": 0})"),
                    {rgb_png("\x20\x20\x20\x90\x90\x90")},
                    {},
                    R"("KHR_materials_anisotropy")"}),
            Lines{"TEXTURE_CHANNELS_EQUAL "
                  "/materials/0/extensions/KHR_materials_anisotropy/anisotropyTexture"});
  EXPECT_EQ(needed({base_color(), {rgb_png("\x20\x20\x20\x90\x90\x90")}}), Lines{})
      << "a grey picture";
}

TEST(NormalMaps, ThatAreFlatAreAHint) {
  const Textured flat{R"("normalTexture": {"index": 0})", {rgb_png("\x80\x80\xFF\x7F\x80\xFF")}};
  EXPECT_EQ(needed(flat), Lines{});
  EXPECT_EQ(hints(flat, "NORMAL_MAP_FLAT"), Lines{"NORMAL_MAP_FLAT" + kSlot});
}

}  // namespace
}  // namespace gltfx::test
