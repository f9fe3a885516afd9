// SPDX-License-Identifier: Apache-2.0
// Slots that share an image: color spaces, packing.
#include <string>

#include <gtest/gtest.h>

#include "rules/textured.hpp"

namespace gltfx::test {
namespace {

// --- Color spaces ---

std::string color_and_occlusion(int image = 0, const std::string& more = {}) {
  return base_color(fmt::format(R"(, "occlusionTexture": {{"index": {}{}}})", image, more));
}
const Lines kConflict{"TEXTURE_COLOR_SPACE_CONFLICT /materials/0/occlusionTexture"};

TEST(ColorSpace, OneChannelIsNotBoth) {
  EXPECT_EQ(about_textures({color_and_occlusion(), {rgb_png()}}), kConflict);
  EXPECT_EQ(about_textures({color_and_occlusion(), {jpeg_header()}}), kConflict);
  EXPECT_EQ(about_textures({color_and_occlusion(), {grey_png()}}), kConflict);
  EXPECT_EQ(about_textures({color_and_occlusion(1), {rgb_png(), grey_png()}}), Lines{});
}

TEST(ColorSpace, BothSlotsAreNamed) {
  EXPECT_EQ(
      message(Textured{color_and_occlusion(), {rgb_png()}}.text(), "TEXTURE_COLOR_SPACE_CONFLICT"),
      "occlusionTexture reads R of image 0 as linear, but baseColorTexture of material 0 reads it "
      "as sRGB.");
}

TEST(ColorSpace, AlphaBesideColoursIsTheIntendedPacking) {
  const Textured textured{
      base_color(extension("KHR_materials_specular", R"("specularTexture": {"index": 0})", ", ")),
      {rgba_png()},
      {},
      R"("KHR_materials_specular")"};
  EXPECT_EQ(about_textures(textured), Lines{});
}

TEST(ColorSpace, OtherChannelsDoNotMeet) {
  const auto emissive = [](const std::string& factor) {
    return about_textures({R"("emissiveFactor": )" + factor +
                               R"(, "emissiveTexture": {"index": 0},
                                  "occlusionTexture": {"index": 0})",
                           {rgb_png()}});
  };
  EXPECT_EQ(emissive("[0, 1, 1]"), Lines{}) << "R is only read by occlusion";
  EXPECT_EQ(emissive("[1, 0, 0]").size(), 1U);
}

TEST(ColorSpace, TwoTexturesOfOneImageAreOneImage) {
  EXPECT_EQ(
      about_textures({color_and_occlusion(1), {rgb_png()}, R"({"source": 0}, {"source": 0})"}),
      kConflict);
}

TEST(ColorSpace, MaterialsShareTheirImages) {
  const std::string materials =
      fmt::format(R"({{{}}}, {{"normalTexture": {{"index": 0}}}})", base_color());
  EXPECT_EQ(about_textures({materials, {rgb_png()}}),
            Lines{"TEXTURE_COLOR_SPACE_CONFLICT /materials/1/normalTexture"});
}

TEST(ColorSpace, BlackAndWhiteAreTheSameInBoth) {
  const std::string one_bit = encode_png({8, 1, PngColor::grey, 1, "\x5A", {}});
  EXPECT_EQ(about_textures({color_and_occlusion(), {one_bit}}), Lines{});
  EXPECT_EQ(
      about_textures({color_and_occlusion(), {palette_png(std::string("\0\0\0\xFF\xFF\xFF", 6))}}),
      Lines{});
  EXPECT_EQ(about_textures({color_and_occlusion(), {palette_png("\1\1\1")}}), kConflict);
}

TEST(ColorSpace, OnceForAnImage) {
  EXPECT_EQ(
      about_textures({color_and_occlusion(0, R"(}, "normalTexture": {"index": 0)"), {rgb_png()}})
          .size(),
      1U);
}

// --- Packing ---

std::string packed_textures(const std::string& occlusion,
                            const std::string& other = R"("index": 0)") {
  return R"("pbrMetallicRoughness": {"metallicRoughnessTexture": {)" + other +
         R"(}}, "occlusionTexture": {)" + occlusion + "}";
}
const Lines kDisagree{"TEXTURE_PACKING_DISAGREES /materials/0/occlusionTexture"};

Lines packing(const std::string& material, const std::string& textures = {},
              const std::string& more = {}) {
  const Textured textured{material, {rgb_png()}, textures, R"("KHR_texture_transform")", more};
  return selected(textured.text(), {"TEXTURE_PACKING_DISAGREES"});
}

TEST(Packing, ChannelsLieOnOnePlace) {
  EXPECT_EQ(packing(packed_textures(R"("index": 0)")), Lines{});
  EXPECT_EQ(packing(packed_textures(R"("index": 0, "texCoord": 1)")), kDisagree);
  EXPECT_EQ(
      packing(packed_textures(R"("index": 0, "texCoord": 1)", R"("index": 0, "texCoord": 1)")),
      Lines{});
}

TEST(Packing, WithOneTransform) {
  const auto transform = [](const std::string& members) {
    return R"("index": 0, "extensions": {"KHR_texture_transform": {)" + members + "}}";
  };
  EXPECT_EQ(packing(packed_textures(transform(R"("scale": [2, 2])"))), kDisagree);
  EXPECT_EQ(packing(packed_textures(transform(R"("rotation": 1)"))), kDisagree);
  EXPECT_EQ(packing(packed_textures(transform(R"("offset": [0, 0.5])"))), kDisagree);
  EXPECT_EQ(packing(packed_textures(transform(R"("texCoord": 1)"))), kDisagree);
  EXPECT_EQ(packing(packed_textures(transform(R"("scale": [1, 1], "offset": [0, 0])"))), Lines{})
      << "that is none";
  const std::string both = transform(R"("scale": [2, 2])");
  EXPECT_EQ(packing(packed_textures(both, both)), Lines{});
}

TEST(Packing, WithOneSampler) {
  const std::string textures = R"({"source": 0, "sampler": 0}, {"source": 0, "sampler": 1})";
  const auto samplers = [&](const std::string& list) {
    return packing(packed_textures(R"("index": 1)"), textures, R"(, "samplers": [)" + list + "]");
  };
  EXPECT_EQ(samplers(R"({}, {"wrapS": 33071})"), kDisagree);
  EXPECT_EQ(samplers(R"({}, {"wrapS": 10497, "name": "again"})"), Lines{});
}

TEST(Packing, AnImageShownTwiceIsNotPacked) {
  const std::string material = base_color(
      R"(, "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0, "texCoord": 1})");
  EXPECT_EQ(packing(material), Lines{});
}

TEST(Packing, TransformsOfClampedTexturesStayInside) {
  const auto clamped = [](const std::string& members, const std::string& sampler) {
    const Textured textured{fmt::format(R"("occlusionTexture": {{"index": 0, "extensions": {{
            "KHR_texture_transform": {{{}}}}}}})",
                                        members),
                            {grey_png()},
                            R"({"source": 0, "sampler": 0})",
                            R"("KHR_texture_transform")",
                            fmt::format(R"(, "samplers": [{{{}}}])", sampler)};
    return selected(textured.text(), {"TEXTURE_TRANSFORM_CLAMPED"});
  };
  const Lines hint{"TEXTURE_TRANSFORM_CLAMPED /materials/0/occlusionTexture"};
  EXPECT_EQ(clamped(R"("scale": [2, 1])", R"("wrapS": 33071)"), hint);
  EXPECT_EQ(clamped(R"("scale": [2, 1])", R"("wrapT": 33071)"), Lines{}) << "the other axis";
  EXPECT_EQ(clamped(R"("scale": [2, 1])", ""), Lines{});
  EXPECT_EQ(clamped(R"("offset": [0, -0.5])", R"("wrapT": 33071)"), hint);
  EXPECT_EQ(clamped(R"("offset": [0, 0.5], "scale": [1, 0.5])", R"("wrapT": 33071)"), Lines{});
  EXPECT_EQ(clamped(R"("offset": [0, 1], "scale": [1, -1])", R"("wrapT": 33071)"), Lines{})
      << "turned over";
}

TEST(Packing, OcclusionWouldFitIntoTheOtherImage) {
  const std::string material = packed_textures(R"("index": 1)");
  const Lines hint{"TEXTURE_PACKABLE /materials/0/occlusionTexture"};
  const auto strict = [](const Textured& textured) {
    return selected(textured.text(), {"TEXTURE_PACKABLE"}, Profile::strict);
  };
  EXPECT_EQ(strict({material, {rgb_png(), grey_png()}}), hint);
  EXPECT_EQ(strict({material, {rgb_png(), grey_png("\1\2")}}), Lines{}) << "another size";
  EXPECT_EQ(strict({packed_textures(R"("index": 0)"), {rgb_png()}}), Lines{}) << "it does";
  EXPECT_EQ(strict({packed_textures(R"("index": 1, "texCoord": 1)"), {rgb_png(), grey_png()}}),
            Lines{});
}

}  // namespace
}  // namespace gltfx::test
