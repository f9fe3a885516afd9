// SPDX-License-Identifier: Apache-2.0
// Measures of pixels, by construction.
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/support/png_encoder.hpp"
#include "measure/taken.hpp"
#include "measure/texel_mask.hpp"
#include "measure/uv_asset.hpp"

namespace gltfx {
namespace {

using test::operator+;
using test::PngColor;
using test::quad;
using test::Taken;
using test::UvAsset;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

std::string png(std::uint32_t width, std::uint32_t height, PngColor color,
                const std::vector<int>& values, char bits = 8) {
  std::string texels;
  for (const int value : values) {
    if (bits == 16) texels += static_cast<char>(value / 256);
    texels += static_cast<char>(value % 256);
  }
  return test::encode_png({width, height, color, bits, texels});
}

// Of the image alone.
Taken image(const std::string& bytes) { return Taken(UvAsset().texture(bytes).text()); }
double value(const Taken& values, std::string_view name) {
  return values.number(name, 0, MeasureScope::image);
}

TEST(ImageValues, AreThoseOfTheLargestChannel) {
  const Taken values = image(png(2, 1, PngColor::rgb, {40, 30, 20, 0, 0, 200}));
  EXPECT_EQ(value(values, "value-min"), 40);
  EXPECT_EQ(value(values, "value-max"), 200);
  EXPECT_FALSE(std::get<bool>(values.value(MeasureScope::image, "constant")));
  EXPECT_EQ(values.of_asset("value-max"), 200);
}

TEST(ImageValues, OfAllImagesHaveOneLimitOfTexels) {
  UvAsset asset;
  for (int i = 0; i < 9; ++i) asset.texture(16384, 8192);  // 2^27 texels, by their headers
  const Taken values(asset.text());
  EXPECT_EQ(values.reason("value-min", 7, MeasureScope::image).text,
            "The image could not be decoded.");
  EXPECT_EQ(values.reason("value-min", 8, MeasureScope::image).text,
            "The images of the asset exceed the limit on texels.");
}

TEST(ImageValues, LeaveOutTransparentTexels) {
  const Taken values =
      image(png(3, 1, PngColor::rgba, {1, 1, 1, 0, 90, 80, 70, 1, 255, 255, 255, 0}));
  EXPECT_EQ(value(values, "value-min"), 90);
  EXPECT_EQ(value(values, "value-max"), 90);
  const Taken none = image(png(1, 1, PngColor::grey_alpha, {1, 0}));
  EXPECT_FALSE(none.reason("value-max", 0, MeasureScope::image).fault);
}

TEST(ImageValues, AreCodesOfEightBits) {
  const Taken values = image(png(2, 1, PngColor::grey, {0x0808, 0xFFFF}, 16));
  EXPECT_EQ(value(values, "value-min"), 8);
  EXPECT_EQ(value(values, "value-max"), 255);
}

TEST(ImageValues, AConstantImageHasOneTexel) {
  EXPECT_TRUE(std::get<bool>(
      image(png(2, 1, PngColor::rgb, {1, 2, 3, 1, 2, 3})).value(MeasureScope::image, "constant")));
  EXPECT_FALSE(std::get<bool>(
      image(png(2, 1, PngColor::grey_alpha, {1, 2, 1, 3})).value(MeasureScope::image, "constant")));
}

TEST(ImageValues, AreNotTakenUnlessPixelsAreAskedFor) {
  const std::string text = UvAsset().texture(png(1, 1, PngColor::grey, {7})).text();
  const Taken values(text, measure::Request());
  EXPECT_THAT(values.reason("value-min", 0, MeasureScope::image).text,
              HasSubstr("--pixels needed"));
  EXPECT_TRUE(values.reason("albedo-min").fault);
}

TEST(ImageValues, AnImageThatCannotBeDecodedIsAFault) {
  const Taken values = image(test::png());
  EXPECT_TRUE(values.reason("value-min", 0, MeasureScope::image).fault);
  EXPECT_TRUE(values.reason("albedo-min").fault);
}

// Four texels in a row.
UvAsset stripes(const UvAsset::Json& sampler = UvAsset::Json::object()) {
  return UvAsset().texture(png(4, 1, PngColor::grey, {10, 50, 100, 200}), sampler);
}

TEST(Albedo, IsWhatTrianglesCover) {
  const Taken values(stripes().add(quad(0.25, 0, 0.75, 1)).text());
  EXPECT_EQ(values.number("albedo-min"), 50);
  EXPECT_EQ(values.number("albedo-max"), 100);
  const Taken more(stripes().add(quad(0.25, 0, 0.8F, 1)).text());
  EXPECT_EQ(more.number("albedo-max"), 200);
  const Taken point(stripes().add({{{{0.1F, 0.5F}, {0.1F, 0.5F}, {0.1F, 0.5F}}}}).text());
  EXPECT_EQ(point.number("albedo-max"), 10)
      << "a triangle without an area has the color of a texel";
}

TEST(Albedo, FollowsTheSampler) {
  const auto range = [](int wrap, float from, float to) {
    const Taken values(stripes({{"wrapS", wrap}}).add(quad(from, 0, to, 1)).text());
    return std::pair(values.number("albedo-min"), values.number("albedo-max"));
  };
  EXPECT_EQ(range(10497, 1.25, 1.75), std::pair(50.0, 100.0)) << "repeats";
  EXPECT_EQ(range(10497, -0.25, 0.25), std::pair(10.0, 200.0)) << "repeats";
  EXPECT_EQ(range(33071, 1.25, 1.75), std::pair(200.0, 200.0)) << "clamps";
  EXPECT_EQ(range(33648, 1.25, 1.5), std::pair(100.0, 100.0)) << "mirrors";
  EXPECT_EQ(range(33648, -0.5, -0.25), std::pair(50.0, 50.0)) << "mirrors";
  EXPECT_EQ(range(33648, 1.75, 2.25), std::pair(10.0, 10.0)) << "mirrors";
}

TEST(Albedo, FollowsTheTransformOfTheTexture) {
  UvAsset asset = stripes();
  asset.made.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
      {"KHR_texture_transform", {{"scale", {0.25, 1}}, {"offset", {0.5, 0}}}}};
  EXPECT_EQ(Taken(asset.add(quad(0, 0, 1, 1)).text()).number("albedo-max"), 100);
}

TEST(Albedo, IsMultipliedInLinearLight) {
  UvAsset asset = UvAsset().texture(png(1, 1, PngColor::rgb, {188, 0, 0})).add(quad(0, 0, 1, 1));
  asset.made.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 1, 1, 1};
  EXPECT_THAT(Taken(asset.text()).number("albedo-max"), DoubleNear(137.3, 0.1));
}

TEST(Albedo, WithoutATextureIsTheFactor) {
  UvAsset asset;
  asset.made.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.2, 0, 1}}}}});
  const Taken values(asset.add(quad(0, 0, 1, 1)).add(quad(0, 0, 1, 1), -1).text(), {});
  EXPECT_THAT(values.number("albedo-max"), DoubleNear(187.5, 0.1));
  EXPECT_EQ(values.number("albedo-min", 1), 255) << "without a material";
}

using Texels = std::set<std::uint64_t>;

Texels covered(const std::array<measure::TexelPoint, 3>& triangle, const model::Sampler& sampler) {
  measure::TexelMask mask(8, 4, sampler);
  EXPECT_TRUE(mask.cover(triangle));
  Texels texels;
  mask.for_each([&](std::uint64_t texel) { texels.insert(texel); });
  return texels;
}

TEST(TexelMask, CoversWhatATriangleMeets) {
  EXPECT_THAT(covered({{{1, 1}, {3, 1}, {1, 3}}}, {}), ElementsAre(9, 10, 17));
  EXPECT_THAT(covered({{{1.9, 1.9}, {2.1, 1.9}, {2, 2.1}}}, {}), ElementsAre(9, 10, 17, 18));
  EXPECT_THAT(covered({{{2, 1}, {3, 1}, {3, 2}}}, {}), ElementsAre(10)) << "touches others";
}

TEST(TexelMask, TilesDoNotMatterWhereTheTextureRepeats) {
  const auto moved = [](double x, double y, const model::Sampler& sampler) {
    return covered({{{1.2 + x, 0.3 + y}, {3.4 + x, 1.7 + y}, {0.3 + x, 2.9 + y}}}, sampler);
  };
  for (const double tile : {-3.0, -1.0, 1.0, 5.0}) {
    EXPECT_EQ(moved(8 * tile, 4 * tile, {}), moved(0, 0, {}));
    const model::Sampler mirrored{model::Wrap::mirrored_repeat, model::Wrap::mirrored_repeat};
    EXPECT_EQ(moved(16 * tile, 8 * tile, mirrored), moved(0, 0, mirrored));
    EXPECT_NE(moved(8, 0, mirrored), moved(0, 0, mirrored));
  }
}

TEST(TexelMask, GivesUpWhenTheWorkIsTooMuch) {
  measure::TexelMask mask(8, 4, {});
  EXPECT_TRUE(mask.cover({{{0, 0}, {1e9, 0}, {0, 1e9}}})) << "all is covered soon";
  measure::TexelMask thin(8, 4, {});
  EXPECT_FALSE(thin.cover({{{0.1, 0}, {0.2, 0}, {0.1, 1e30}}}));
}

}  // namespace
}  // namespace gltfx
