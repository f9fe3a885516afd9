// SPDX-License-Identifier: Apache-2.0
// KTX2 images in extensions, samplers and slots.
#include <string>

#include <gtest/gtest.h>

#include "image/ktx2_builder.hpp"
#include "rules/textured.hpp"

namespace gltfx::test {
namespace {

const std::string kImage = " /images/0";
const std::string kBasis = "KHR_texture_basisu";
// A sampler without mipmaps.
const std::string kPlainSampler = R"(, "samplers": [{"minFilter": 9729}])";

Textured shown_ktx2(const Ktx2Builder& image, const std::string& material = base_color(),
                    const std::string& name = kBasis) {
  return {material,
          {image.file()},
          R"({"sampler": 0, "extensions": {")" + name + R"(": {"source": 0}}})",
          '"' + name + R"("], "extensionsRequired": [")" + name + '"',
          kPlainSampler};
}

Lines about_ktx2(const Ktx2Builder& image, const std::string& material = base_color()) {
  return about_textures(shown_ktx2(image, material));
}

const std::string kOcclusion = R"("occlusionTexture": {"index": 0})";

TEST(Ktx2Images, ThatAreRightAreSilent) {
  EXPECT_EQ(about_ktx2(Ktx2Builder()), Lines{});
  EXPECT_EQ(about_ktx2(Ktx2Builder::etc1s()), Lines{});
  EXPECT_EQ(about_ktx2(Ktx2Builder::etc1s({0, 15}), base_color(R"(, "alphaMode": "BLEND")")),
            Lines{});
  EXPECT_EQ(about_ktx2(Ktx2Builder::etc1s({3}).linear(), kOcclusion), Lines{});
  Ktx2Builder zstd;
  zstd.scheme = 2;
  EXPECT_EQ(about_ktx2(zstd), Lines{});
}

TEST(Ktx2Images, ErrorsOfTheFileAreAtTheImage) {
  Textured textured = shown_ktx2(Ktx2Builder());
  const auto with = [&](std::size_t offset, const std::string& bytes) {
    Textured broken = textured;
    broken.images[0] = patched(broken.images[0], offset, bytes);
    return about_textures(broken);
  };
  EXPECT_EQ(with(16, le(2, 4)), Lines{"KTX2_HEADER_INVALID" + kImage});
  EXPECT_EQ(with(48, le(9999, 4)), Lines{"KTX2_INDEX_INVALID" + kImage});
  EXPECT_EQ(with(80, le(9999, 8)), Lines{"KTX2_LEVEL_INVALID" + kImage});
  EXPECT_EQ(with(112, le(1, 2)), Lines{"KTX2_DESCRIPTOR_INVALID" + kImage});
  EXPECT_EQ(with(64, le(104, 8) + le(8, 8)).front(), "KTX2_INDEX_INVALID" + kImage);
}

TEST(Ktx2Images, HaveAFormatThatTheirDescriptorDescribes) {
  Ktx2Builder uastc;
  uastc.vk_format = 37;
  EXPECT_EQ(about_ktx2(uastc), Lines{"KTX2_FORMAT_MISMATCH" + kImage});
  Ktx2Builder linear = Ktx2Builder::astc();
  linear.vk_format = 157;
  EXPECT_EQ(about_textures(shown_ktx2(linear, base_color(), "EXT_texture_astc")),
            Lines{"KTX2_FORMAT_MISMATCH" + kImage});
}

TEST(Ktx2Images, ThatReadersShowAllTheSameAreCheckedFurther) {
  Ktx2Builder linear = Ktx2Builder::astc();
  linear.vk_format = 157;
  const Textured textured = shown_ktx2(linear, kOcclusion, "EXT_texture_astc");
  EXPECT_EQ(about_textures(textured),
            (Lines{"KTX2_FORMAT_MISMATCH" + kImage,
                   "KTX2_COLOR_SPACE_INVALID /materials/0/occlusionTexture"}));
  ValidateOptions options;
  options.select = {"KTX2_FORMAT_MISMATCH"};
  const FileReport report = validate_bytes(textured.text(), "test", options);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
}

TEST(Ktx2Images, AreFlat) {
  Ktx2Builder layered;
  layered.layers = 1;
  EXPECT_EQ(about_ktx2(layered), Lines{"KTX2_NOT_2D" + kImage});
}

TEST(Ktx2Images, HaveExtentsOfWholeBlocks) {
  Ktx2Builder odd;
  odd.width = 6;
  EXPECT_EQ(about_ktx2(odd), Lines{"KTX2_DIMENSIONS_NOT_MULTIPLE_OF_4" + kImage});
}

TEST(Ktx2Images, HaveNoOrientationOrSwizzleOfTheirOwn) {
  Ktx2Builder builder;
  builder.metadata = {{"KTXorientation", "ru"}};
  EXPECT_EQ(about_ktx2(builder), Lines{"KTX2_ORIENTATION_INVALID" + kImage});
  builder.metadata = {{"KTXswizzle", "bgra"}};
  EXPECT_EQ(about_ktx2(builder), Lines{"KTX2_SWIZZLE_INVALID" + kImage});
  builder.metadata = {{"KTXorientation", "rd"}, {"KTXswizzle", "rgba"}};
  EXPECT_EQ(about_ktx2(builder), Lines{});
}

TEST(Ktx2Images, HaveStraightAlpha) {
  Ktx2Builder builder;
  builder.flags = 1;
  EXPECT_EQ(about_ktx2(builder), Lines{"KTX2_PREMULTIPLIED_ALPHA" + kImage});
}

TEST(Ktx2Images, HoldWhatTheirExtensionAllows) {
  const Lines bad{"KTX2_PAYLOAD_INVALID" + kImage};
  const Ktx2Builder astc = Ktx2Builder::astc();
  EXPECT_EQ(about_ktx2(astc), bad);
  EXPECT_EQ(about_textures(shown_ktx2(astc, base_color(), "EXT_texture_astc")), Lines{});
  EXPECT_EQ(about_textures(shown_ktx2(Ktx2Builder(), base_color(), "EXT_texture_astc")), bad);
  Ktx2Builder unknown_channel;
  unknown_channel.channels = {5};
  EXPECT_EQ(about_ktx2(unknown_channel), bad);
  Ktx2Builder zlib;
  zlib.scheme = 3;
  EXPECT_EQ(about_ktx2(zlib), bad);
}

TEST(Ktx2Images, HaveTheLevelsThatSamplersRead) {
  Ktx2Builder one;
  Textured textured = shown_ktx2(one);
  const Lines missing{"KTX2_MIP_LEVELS_MISSING /textures/0/extensions/KHR_texture_basisu/source"};
  textured.more = R"(, "samplers": [{"minFilter": 9987}])";
  EXPECT_EQ(about_textures(textured), missing);
  textured.more = R"(, "samplers": [{"magFilter": 9728}])";
  EXPECT_EQ(about_textures(textured), Lines{}) << "no mipmaps asked for";
  textured.more = "";
  textured.textures = R"({"extensions": {"KHR_texture_basisu": {"source": 0}}})";
  EXPECT_EQ(about_textures(textured), missing) << "readers choose";
  one.levels = 3;
  textured.images = {one.file()};
  EXPECT_EQ(about_textures(textured), Lines{});
}

TEST(Ktx2Slots, ReadTheColourSpaceThatIsDeclared) {
  const std::string color =
      "KTX2_COLOR_SPACE_INVALID "
      "/materials/0/pbrMetallicRoughness/baseColorTexture";
  EXPECT_EQ(about_ktx2(Ktx2Builder().linear()), Lines{color});
  EXPECT_EQ(about_ktx2(Ktx2Builder(), kOcclusion),
            Lines{"KTX2_COLOR_SPACE_INVALID /materials/0/occlusionTexture"});
  EXPECT_EQ(about_ktx2(Ktx2Builder().linear(), kOcclusion), Lines{});
}

TEST(Ktx2Slots, OneOfTwoIsWrong) {
  EXPECT_EQ(about_ktx2(Ktx2Builder(), base_color(R"(, "occlusionTexture": {"index": 0})")),
            Lines{"KTX2_COLOR_SPACE_INVALID /materials/0/occlusionTexture"});
}

TEST(Ktx2Slots, WrongPrimariesAreOnlyAWarning) {
  Ktx2Builder tagged = Ktx2Builder().linear();
  tagged.primaries = 1;
  const auto severity = [&](const Ktx2Builder& image) {
    ValidateOptions options;
    options.select = {"KTX2_COLOR_SPACE_INVALID"};
    const auto report = validate_bytes(shown_ktx2(image, kOcclusion).text(), "test", options);
    return report.diagnostics.empty() ? Severity::hint : report.diagnostics[0].severity;
  };
  EXPECT_EQ(severity(tagged), Severity::warning);
  EXPECT_EQ(severity(Ktx2Builder()), Severity::error);
}

TEST(Ktx2Slots, ReadChannelsThatAreThere) {
  const std::string roughness =
      R"("pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}})";
  const Lines missing{
      "KTX2_CHANNELS_MISSING /materials/0/pbrMetallicRoughness/metallicRoughnessTexture"};
  EXPECT_EQ(about_ktx2(Ktx2Builder::etc1s({3}).linear(), roughness), missing);
  EXPECT_EQ(about_ktx2(Ktx2Builder::etc1s({3, 4}).linear(), roughness), missing);
  EXPECT_EQ(about_ktx2(Ktx2Builder::etc1s({0}).linear(), roughness), Lines{});
}

TEST(Ktx2Slots, AlphaIsASampleOfItsOwn) {
  const std::string specular =
      extension("KHR_materials_specular", R"("specularTexture": {"index": 0})");
  const auto said = [&](const Ktx2Builder& image) {
    return selected(shown_ktx2(image, specular).text(), {"TEXTURE_ALPHA_MISSING"});
  };
  EXPECT_EQ(said(Ktx2Builder::etc1s({0, 15}).linear()), Lines{});
  EXPECT_EQ(said(Ktx2Builder::etc1s({0}).linear()),
            Lines{"TEXTURE_ALPHA_MISSING /materials/0/extensions/KHR_materials_specular/"
                  "specularTexture"});
}

}  // namespace
}  // namespace gltfx::test
