// SPDX-License-Identifier: Apache-2.0
/// Image formats that are not part of glTF, through their worker. The tests need OpenImageIO, which
/// tools/test installs.
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/client.hpp"
#include "codec/support/foreign_files.hpp"
#include "codec/support/results.hpp"

namespace gltfx::codec {
namespace {

using test::kForeignTexels;
using test::TiffAlpha;
using testing::HasSubstr;

ImageRequest foreign_request(const std::string& bytes, ImageFormat format) {
  ImageRequest request;
  request.bytes = std::as_bytes(std::span(bytes.data(), bytes.size()));
  request.format = format;
  request.pixels = true;
  request.max_pixels = 4096;
  return request;
}

Image foreign_image(const ImageRequest& request) {
  return test::value_of(Client::shared().decode_image(request));
}

DecodeError foreign_error(const ImageRequest& request) {
  return test::error_of(Client::shared().decode_image(request));
}

std::string jp2_file() {
  std::ifstream file(GLTFX_SOURCE_DIR "/tests/codec/foreign/flat.jp2", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

struct ForeignCase {
  const char* name;
  ImageFormat format;
  std::string bytes;
};

std::vector<ForeignCase> foreign_cases() {
  return {{"bmp", ImageFormat::bmp, test::bmp_file()},
          {"tga", ImageFormat::tga, test::tga_file()},
          {"tga without a footer", ImageFormat::tga, test::tga_file(false)},
          {"gif", ImageFormat::gif, test::gif_file()},
          {"tiff", ImageFormat::tiff, test::tiff_file(TiffAlpha::none)},
          {"tiff with alpha", ImageFormat::tiff, test::tiff_file(TiffAlpha::unassociated)},
          {"psd", ImageFormat::psd, test::psd_file()},
          {"dds", ImageFormat::dds, test::dds_file()},
          {"ppm", ImageFormat::pnm, test::ppm_file()}};
}

TEST(OpenImageIo, TexelsAreThoseOfTheFile) {
  for (const ForeignCase& each : foreign_cases()) {
    const Image image = foreign_image(foreign_request(each.bytes, each.format));
    ASSERT_EQ(image.width, test::kForeignWidth) << each.name;
    ASSERT_EQ(image.height, test::kForeignHeight) << each.name;
    ASSERT_EQ(image.bits, 8U) << each.name;
    ASSERT_GE(image.channels, 3U) << each.name;
    const bool alpha = image.channels == 4 && each.format != ImageFormat::gif;
    for (std::size_t i = 0; i < kForeignTexels.size(); ++i) {
      for (std::size_t c = 0; c < (alpha ? 4 : 3); ++c) {
        EXPECT_EQ(std::to_integer<int>(image.pixels[i * image.channels + c]), kForeignTexels[i][c])
            << each.name << ", texel " << i << ", channel " << c;
      }
    }
  }
}

TEST(OpenImageIo, AlphaIsThereWhereTheFileHasIt) {
  for (const ForeignCase& each : foreign_cases()) {
    const bool alpha = std::string(each.name).find("alpha") != std::string::npos ||
                       each.format == ImageFormat::tga || each.format == ImageFormat::dds;
    if (!alpha) continue;
    const Image image = foreign_image(foreign_request(each.bytes, each.format));
    ASSERT_EQ(image.channels, 4U) << each.name;
    EXPECT_EQ(image.alpha().least, 0U);
    EXPECT_EQ(image.alpha().greatest, 255U);
  }
}

TEST(OpenImageIo, GifsHaveAlphaOnlyIfTexelsAreTransparent) {
  const std::string opaque = test::gif_file();
  EXPECT_EQ(foreign_image(foreign_request(opaque, ImageFormat::gif)).channels, 3U);
  const std::string keyed = test::gif_file(true);
  const Image image = foreign_image(foreign_request(keyed, ImageFormat::gif));
  ASSERT_EQ(image.channels, 4U);
  EXPECT_EQ(std::to_integer<int>(image.pixels[3]), 0) << "the color with index 0";
  EXPECT_EQ(std::to_integer<int>(image.pixels[7]), 255);
  const std::string partial = test::gif_file(false, 1);
  const Image half = foreign_image(foreign_request(partial, ImageFormat::gif));
  ASSERT_EQ(half.channels, 4U);
  EXPECT_EQ(std::to_integer<int>(half.pixels[3]), 255);
  EXPECT_EQ(std::to_integer<int>(half.pixels[31]), 0) << "not covered by the frame";
}

TEST(OpenImageIo, TheFourthByteOfABmpWithoutMasksIsNoAlpha) {
  const std::string bytes = test::unused_byte_bmp_file();
  const Image image = foreign_image(foreign_request(bytes, ImageFormat::bmp));
  ASSERT_EQ(image.channels, 3U);
  EXPECT_EQ(std::to_integer<int>(image.pixels[0]), 200);
  EXPECT_EQ(std::to_integer<int>(image.pixels[23]), 5);
}

TEST(OpenImageIo, TheSecondChannelOfATgaIsAlpha) {
  const std::string bytes = test::grey_alpha_tga_file();
  const Image image = foreign_image(foreign_request(bytes, ImageFormat::tga));
  ASSERT_EQ(image.channels, 2U);
  EXPECT_EQ(std::to_integer<int>(image.pixels[0]), 200);
  EXPECT_EQ(std::to_integer<int>(image.pixels[1]), 128);
}

TEST(OpenImageIo, FilesWhoseTexelsWouldBeWrongAreRefused) {
  for (const std::string& bytes :
       {test::one_bit_alpha_tga_file(), test::alpha_palette_tga_file()}) {
    EXPECT_THAT(foreign_error(foreign_request(bytes, ImageFormat::tga)).message,
                HasSubstr("alpha"));
  }
  const std::string bilevel = test::default_bits_tiff_file();
  EXPECT_THAT(foreign_error(foreign_request(bilevel, ImageFormat::tiff)).message,
              HasSubstr("bits"));
}

TEST(OpenImageIo, ColoursThatWereMultipliedByAlphaAreDivided) {
  const std::string bytes = test::tiff_file(TiffAlpha::associated);
  const Image image = foreign_image(foreign_request(bytes, ImageFormat::tiff));
  ASSERT_EQ(image.channels, 4U);
  EXPECT_NEAR(std::to_integer<int>(image.pixels[0]), 200, 1);
  EXPECT_NEAR(std::to_integer<int>(image.pixels[1]), 100, 1);
  EXPECT_EQ(std::to_integer<int>(image.pixels[3]), 128);
}

TEST(OpenImageIo, SoIsGreyThatWasMultiplied) {
  for (const TiffAlpha alpha : {TiffAlpha::associated, TiffAlpha::unassociated}) {
    const std::string bytes = test::tiff_file(alpha, false, true);
    const Image image = foreign_image(foreign_request(bytes, ImageFormat::tiff));
    ASSERT_EQ(image.channels, 2U);
    EXPECT_NEAR(std::to_integer<int>(image.pixels[0]), 200, 1);
    EXPECT_EQ(std::to_integer<int>(image.pixels[1]), 128);
    EXPECT_NEAR(std::to_integer<int>(image.pixels[12]), 77, 3);
  }
}

TEST(OpenImageIo, ATgaMaySayThatItIsMultiplied) {
  const std::string bytes = test::multiplied_tga_file();
  const Image image = foreign_image(foreign_request(bytes, ImageFormat::tga));
  ASSERT_EQ(image.channels, 4U);
  EXPECT_EQ(std::to_integer<int>(image.pixels[0]), 255) << "200 of at most 128";
  EXPECT_EQ(std::to_integer<int>(image.pixels[1]), 199) << "100 / 128 of 255";
  EXPECT_EQ(std::to_integer<int>(image.pixels[3]), 128);
  EXPECT_EQ(std::to_integer<int>(image.pixels[8]), 255);
}

// The plugin divides DXT2 and DXT4 itself.
TEST(OpenImageIo, MultipliedBlocksOfDdsAreDividedOnce) {
  for (const auto& [format, red] : {std::pair("DXT4", 131), std::pair("DXT5", 66)}) {
    const std::string bytes = test::dxt_file(format);
    const Image image = foreign_image(foreign_request(bytes, ImageFormat::dds));
    ASSERT_EQ(image.channels, 4U) << format;
    EXPECT_EQ(std::to_integer<int>(image.pixels[0]), red) << format;
    EXPECT_EQ(std::to_integer<int>(image.pixels[3]), 128) << format;
  }
}

TEST(OpenImageIo, FloatsAreForEnvironmentsAlone) {
  const std::string bytes = test::tiff_file(TiffAlpha::none, true);
  ImageRequest request = foreign_request(bytes, ImageFormat::tiff);
  const DecodeError error = foreign_error(request);
  EXPECT_EQ(error.kind, ErrorKind::malformed);
  EXPECT_THAT(error.message, HasSubstr("floating-point"));
  request.floats = true;
  const Image image = foreign_image(request);
  ASSERT_EQ(image.bits, 32U);
  float first = 0;
  std::memcpy(&first, image.pixels.data(), sizeof first);
  EXPECT_EQ(first, 100);
}

TEST(OpenImageIo, Jpeg2000IsDecoded) {
  const std::string bytes = jp2_file();
  const Image image = foreign_image(foreign_request(bytes, ImageFormat::jpeg2000));
  EXPECT_EQ(image.width, 64U);
  EXPECT_NEAR(image.statistics[0].least, 204, 2);
  EXPECT_NEAR(image.statistics[2].greatest, 51, 2);
}

TEST(OpenImageIo, ThePromisedFormatIsTried) {
  const std::string gif = test::gif_file();
  EXPECT_EQ(foreign_error(foreign_request(gif, ImageFormat::bmp)).kind, ErrorKind::malformed);
  const std::string png = "\x89PNG\r\n\x1a\n";
  EXPECT_EQ(foreign_error(foreign_request(png, ImageFormat::tiff)).kind, ErrorKind::malformed);
}

TEST(OpenImageIo, TooManyTexelsAreRefusedFirst) {
  const std::string bytes = test::bmp_file(60000);
  EXPECT_EQ(foreign_error(foreign_request(bytes, ImageFormat::bmp)).kind, ErrorKind::too_large);
}

TEST(OpenImageIo, AForeignImageBecomesAPng) {
  const std::string bytes = test::tga_file();
  TranscodeRequest request;
  request.image = foreign_request(bytes, ImageFormat::tga);
  const EncodedImage file = test::value_of(Client::shared().transcode_image(request));
  EXPECT_EQ(file.raster, (Raster{4, 2, 4, 8}));
  ImageRequest again;
  again.bytes = file.bytes;
  again.pixels = true;
  const Image image = foreign_image(again);
  EXPECT_EQ(std::memcmp(image.pixels.data(), kForeignTexels.data(), 32), 0);
  request.image.resize.max_side = 2;
  const EncodedImage small = test::value_of(Client::shared().transcode_image(request));
  EXPECT_EQ(small.raster, (Raster{2, 1, 4, 8}));
  ImageRequest pixels = request.image;
  EXPECT_EQ(foreign_image(pixels).width, 2U);
}

TEST(OpenImageIo, WithoutTheDecoderItsPackageIsNamed) {
  Settings settings;
  settings.folder = GLTFX_SOURCE_DIR;  // no programs
  Client client(settings);
  const std::string bytes = test::gif_file();
  const ImageResult result = client.decode_image(foreign_request(bytes, ImageFormat::gif));
  const auto* error = std::get_if<DecodeError>(&result);
  ASSERT_NE(error, nullptr);
  EXPECT_EQ(error->kind, ErrorKind::unavailable);
  EXPECT_THAT(error->message, HasSubstr("gltfx-openimageio"));
}

// Whether the worker answered or ended, without waiting for it.
bool ended_well(const std::string& bytes, ImageFormat format) {
  const ImageResult result = Client::shared().decode_image(foreign_request(bytes, format));
  const auto* error = std::get_if<DecodeError>(&result);
  return error == nullptr ||
         (error->kind != ErrorKind::unavailable && error->kind != ErrorKind::stalled);
}

TEST(OpenImageIo, EveryCutIsAnErrorOrAnImage) {
  for (const ForeignCase& each : foreign_cases()) {
    for (std::size_t size = 0; size < each.bytes.size(); size += size < 60 ? 1 : 7) {
      EXPECT_TRUE(ended_well(each.bytes.substr(0, size), each.format)) << each.name << ' ' << size;
    }
  }
  const std::string jp2 = jp2_file();
  for (std::size_t size = 0; size < jp2.size(); size += 5) {
    EXPECT_TRUE(ended_well(jp2.substr(0, size), ImageFormat::jpeg2000)) << size;
  }
}

TEST(OpenImageIo, EveryByteMayBeAnother) {
  for (const ForeignCase& each : foreign_cases()) {
    for (std::size_t at = 0; at < each.bytes.size(); ++at) {
      std::string changed = each.bytes;
      changed[at] = static_cast<char>(changed[at] ^ (at % 2 == 0 ? 0xFF : 0x10));
      EXPECT_TRUE(ended_well(changed, each.format)) << each.name << ' ' << at;
    }
  }
}

}  // namespace
}  // namespace gltfx::codec
