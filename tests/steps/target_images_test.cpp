// SPDX-License-Identifier: Apache-2.0
// Images are stored in formats that an engine reads.
#include <gmock/gmock.h>

#include "convert_image_support.hpp"
#include "targets_support.hpp"

namespace gltfx::test {
namespace {

constexpr const char* kWebp = "EXT_texture_webp";
constexpr codec::Raster kColor{16, 16, 3, 8};
constexpr codec::Raster kGrey{16, 16, 1, 8};

// A texture that refers to WebP; with a PNG to fall back to, which is image 1.
std::string webp_asset(bool fallback) {
  OrderedJson json = OrderedJson::parse(asset_with(kColorSlot, {file_image("a.webp")}));
  json["textures"][0] = {{"extensions", {{kWebp, {{"source", 0}}}}}};
  json["extensionsUsed"] = {kWebp};
  json["extensionsRequired"] = {kWebp};
  if (fallback) {
    json["textures"][0]["source"] = 1;
    json["images"].push_back({{"uri", "b.png"}});
  }
  return json.dump();
}

ImageConversionCase webp_case(bool fallback, std::uint32_t quality, const TargetChoice& choice) {
  ImageConversionCase test(webp_asset(fallback),
                           {{"a.webp", webp_file(kColor, quality)}, {"b.png", png_file(kColor)}});
  test.options.targets = {choice};
  return test;
}

TEST(TargetImages, BecomePngWithoutLoss) {
  auto test = webp_case(false, 0, refuser({kWebp}));
  const OrderedJson json = test.run();
  EXPECT_EQ(json["textures"][0], OrderedJson::parse(R"({"source": 0})"));
  EXPECT_EQ(json["images"][0]["uri"], "a.png");
  EXPECT_FALSE(json.contains("extensionsUsed"));
  EXPECT_EQ(test.losses(), "");
  EXPECT_EQ(decoded(test.result.files.at("a.png")), decoded(test.asset.files.at("a.webp")));
}

TEST(TargetImages, BecomeJpegIfTheyAreLossyAlready) {
  auto test = webp_case(false, 80, refuser({kWebp}));
  EXPECT_EQ(test.run()["images"][0]["uri"], "a.jpg");
  EXPECT_NE(test.losses().find("JPEG of quality 95"), std::string::npos);
}

TEST(TargetImages, StayIfTheFallbackIsRead) {
  auto test = webp_case(
      true, 0, engine(R"("EXT_texture_webp": {"used": "ignored", "required": "refused"})"));
  const OrderedJson json = test.run();
  EXPECT_FALSE(json.contains("extensionsRequired"));
  EXPECT_EQ(json["extensionsUsed"], OrderedJson::array({kWebp}));
  EXPECT_TRUE(json["textures"][0].contains("extensions"));
  EXPECT_TRUE(test.result.files.empty());
}

TEST(TargetImages, AreLeftOutIfTheFallbackIsTheOnlyOneRead) {
  auto test = webp_case(true, 0, refuser({kWebp}));
  const OrderedJson json = test.run();
  EXPECT_EQ(json["textures"][0], OrderedJson::parse(R"({"source": 1})"));
  EXPECT_EQ(json["images"][0], json["images"][1]);
  EXPECT_FALSE(json.contains("extensionsUsed"));
}

TEST(TargetImages, BecomeRgb) {
  ImageConversionCase test(asset_with(kColorSlot, {file_image("a.png")}),
                           {{"a.png", png_file(kGrey)}});
  test.options.targets = {refuser({"image.png-grayscale"})};
  test.run();
  ASSERT_EQ(test.result.files.size(), 1U);
  const std::string& file = test.result.files.begin()->second;
  EXPECT_EQ(header_of(file).channels, image::Channels::rgb);
  EXPECT_EQ(decoded(file), decoded(test.asset.files.at("a.png")));
  EXPECT_EQ(test.losses(), "");
}

TEST(TargetImages, GetMediaTypes) {
  OrderedJson json = OrderedJson::parse(webp_asset(false));
  ImageConversionCase test(json.dump(), {{"a.webp", webp_file(kColor)}});
  test.options.targets = {refuser({"image.webp-no-mime-type"})};
  EXPECT_EQ(test.run()["images"][0]["mimeType"], "image/webp");
}

}  // namespace
}  // namespace gltfx::test
