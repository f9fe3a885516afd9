// SPDX-License-Identifier: Apache-2.0
// Images in formats that are not allowed become PNG.
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>

#include "codec/support/foreign_files.hpp"
#include "convert_image_support.hpp"

namespace gltfx {
namespace {

using test::asset_with;
using test::decoded;
using test::file_image;
using test::ImageConversionCase;
using test::kBlendedSlot;
using test::kColorSlot;
using test::kNormalSlot;
using test::OrderedJson;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const codec::Raster kPicture{32, 32, 3, 8};

ImageConversionCase made_legal(std::string text, std::map<std::string, std::string> files) {
  ImageConversionCase conversion(std::move(text), std::move(files));
  conversion.options.images = {{ImageTarget::legal, std::nullopt}};
  return conversion;
}

TEST(LegalImages, ReplaceUnsupportedFormats) {
  const std::map<std::string, std::string> files{
      {"a.bmp", test::bmp_file()}, {"a.tga", test::tga_file()},
      {"a.gif", test::gif_file()}, {"a.tif", test::tiff_file(test::TiffAlpha::unassociated)},
      {"a.psd", test::psd_file()}, {"a.dds", test::dds_file()},
      {"a.ppm", test::ppm_file()}};
  for (const auto& [name, file] : files) {
    ImageConversionCase conversion =
        made_legal(asset_with(kBlendedSlot, {file_image(name)}), {{name, file}});
    const OrderedJson json = conversion.run();
    EXPECT_EQ(json["images"].dump(), R"([{"uri":"a.png"}])") << name;
    ASSERT_TRUE(conversion.result.files.contains("a.png")) << name << conversion.left();
    const auto texels = decoded(conversion.result.files.at("a.png"));
    EXPECT_EQ(texels.size(), 4U * test::kForeignWidth * test::kForeignHeight) << name;
    EXPECT_EQ(texels[0], static_cast<std::byte>(test::kForeignTexels[0][0])) << name;
    EXPECT_THAT(conversion.step().losses, IsEmpty()) << name;
  }
}

TEST(LegalImages, KeepAlpha) {
  ImageConversionCase conversion =
      made_legal(asset_with(kBlendedSlot, {file_image("a.tif")}),
                 {{"a.tif", test::tiff_file(test::TiffAlpha::unassociated)}});
  conversion.run();
  const auto texels = decoded(conversion.result.files.at("a.png"));
  for (std::size_t i = 0; i < texels.size(); ++i) {
    EXPECT_EQ(texels[i], static_cast<std::byte>(test::kForeignTexels[i / 4][i % 4])) << i;
  }
}

TEST(LegalImages, ReplaceFormatsThatNoExtensionAllows) {
  const std::string webp = test::webp_file(kPicture);
  ImageConversionCase conversion =
      made_legal(asset_with(kColorSlot, {file_image("a.webp")}), {{"a.webp", webp}});
  const OrderedJson json = conversion.run();
  EXPECT_EQ(json["images"][0]["uri"], "a.png");
  EXPECT_GT(conversion.result.files.at("a.png").size(), webp.size());
  EXPECT_EQ(decoded(conversion.result.files.at("a.png")), decoded(webp));
}

TEST(LegalImages, DoNotChange) {
  const std::string text = R"({"asset": {"version": "2.0"},
    "extensionsUsed": ["EXT_texture_webp"], "extensionsRequired": ["EXT_texture_webp"],
    "textures": [{"extensions": {"EXT_texture_webp": {"source": 0}}}, {"source": 1},
      {"source": 2}],
    "images": [{"uri": "a.webp"}, {"uri": "a.png"}, {"uri": "a.jpg"}]})";
  ImageConversionCase conversion = made_legal(text, {{"a.webp", test::webp_file(kPicture)},
                                                     {"a.png", test::png_file(kPicture)},
                                                     {"a.jpg", test::jpeg_file(kPicture)}});
  conversion.run();
  EXPECT_FALSE(conversion.step().changes);
  EXPECT_THAT(conversion.step().left, IsEmpty());
}

std::string cmyk_file() {
  std::ifstream file(GLTFX_SOURCE_DIR "/tests/codec/foreign/flat-cmyk.jpg", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// glTF allows JPEG files of one and of three channels.
TEST(LegalImages, ReplaceFourInks) {
  ImageConversionCase conversion =
      made_legal(asset_with(kColorSlot, {file_image("a.jpg")}), {{"a.jpg", cmyk_file()}});
  const OrderedJson json = conversion.run();
  EXPECT_EQ(json["images"][0]["uri"], "a.png");
  const auto texels = decoded(conversion.result.files.at("a.png"));
  ASSERT_EQ(texels.size(), 4U * 16 * 16);
  EXPECT_NEAR(std::to_integer<int>(texels[0]), 255, 3);
  EXPECT_NEAR(std::to_integer<int>(texels[1]), 127, 3);
  EXPECT_NEAR(std::to_integer<int>(texels[2]), 0, 3);
  EXPECT_EQ(conversion.losses(), "CMYK as RGB (1 image)\n");
}

// Textures of colors have 8 bits per channel.
TEST(LegalImages, AreRefusedForSixteenBitsOfColor) {
  std::string file = "P6 4 2 65535\n";
  for (unsigned i = 0; i < 48; ++i) file += static_cast<char>(i * 5);
  for (const std::string_view slot : {kColorSlot, kNormalSlot}) {
    ImageConversionCase conversion =
        made_legal(asset_with(slot, {file_image("a.ppm")}), {{"a.ppm", file}});
    conversion.result = convert_bytes(conversion.asset, conversion.options);
    if (slot == kNormalSlot) {
      EXPECT_TRUE(conversion.result.files.contains("a.png"));
      continue;
    }
    ASSERT_THAT(conversion.step().refused, SizeIs(1));
    EXPECT_EQ(conversion.step().refused.front().pointer, "/images/0");
    EXPECT_THAT(conversion.step().refused.front().reason, HasSubstr("16 bits per channel"));
  }
}

TEST(LegalImages, AreRefusedForUnlimitedColors) {
  const std::map<std::string, std::string> files{
      {"a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x80\x80\x80"},
      {"a.tif", test::tiff_file(test::TiffAlpha::none, true)}};
  for (const auto& [name, file] : files) {
    ImageConversionCase conversion =
        made_legal(asset_with(kColorSlot, {file_image(name)}), {{name, file}});
    conversion.result = convert_bytes(conversion.asset, conversion.options);
    EXPECT_EQ(conversion.result.report.problem, EditProblem::refused);
    ASSERT_THAT(conversion.step().refused, SizeIs(1)) << name;
    EXPECT_EQ(conversion.step().refused.front().pointer, "/images/0");
    conversion.options.partial = true;
    conversion.run();
    EXPECT_EQ(conversion.result.bytes, conversion.asset.bytes);
  }
}

TEST(LegalImages, AreRefusedForTooManyTexels) {
  ImageConversionCase conversion = made_legal(asset_with(kColorSlot, {file_image("a.bmp")}),
                                              {{"a.bmp", test::bmp_file(1U << 28U)}});
  conversion.result = convert_bytes(conversion.asset, conversion.options);
  EXPECT_EQ(conversion.result.report.problem, EditProblem::refused);
  EXPECT_THAT(conversion.step().refused, SizeIs(1));
}

TEST(ForeignImages, ConvertToTheRequestedFormat) {
  for (const auto& [target, uri] : std::map<ImageTarget, std::string>{
           {ImageTarget::png, "a.png"}, {ImageTarget::webp, "a.webp"}}) {
    ImageConversionCase conversion(asset_with(kColorSlot, {file_image("a.bmp")}),
                                   {{"a.bmp", test::bmp_file()}});
    conversion.options.images = {{target, std::nullopt}};
    EXPECT_EQ(conversion.run()["images"][0]["uri"], uri);
  }
}

TEST(LegalImages, LeaveAFormatThatAnotherOneDoesNotSupport) {
  ImageConversionCase conversion(asset_with(kColorSlot, {file_image("a.tif")}),
                                 {{"a.tif", test::tiff_file(test::TiffAlpha::unassociated)}});
  conversion.options.images = {{ImageTarget::jpeg, std::nullopt}};
  conversion.run();
  EXPECT_THAT(conversion.left(), HasSubstr("/images/0: not JPEG: "));
  EXPECT_THAT(conversion.step().refused, IsEmpty());
  EXPECT_FALSE(conversion.step().changes);
}

}  // namespace
}  // namespace gltfx
