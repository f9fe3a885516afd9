// SPDX-License-Identifier: Apache-2.0
/// Image files that the worker decodes and encodes again without sending pixels to the caller.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/client.hpp"
#include "codec/support/jpeg_bytes.hpp"
#include "codec/support/results.hpp"
#include "container/base64.hpp"

namespace gltfx::codec {
namespace {

using test::png_file;
using testing::HasSubstr;

// Colours that change slowly with some noise, and alphas, one third of them 0.
std::vector<std::byte> smooth_texels(const Raster& raster, bool opaque = false) {
  std::vector<std::byte> bytes;
  std::uint32_t state = 1;
  for (std::uint32_t i = 0; i < raster.width * raster.height; ++i) {
    for (std::uint32_t c = 0; c < raster.channels; ++c) {
      state = state * 1664525U + 1013904223U;
      const bool alpha = c + 1 == raster.channels && raster.channels % 2 == 0;
      unsigned value = i % raster.width * 2 + i / raster.width + c * 30 + (state >> 28U);
      if (alpha) value = opaque ? 255 : i % 3 == 0 ? 0 : value;
      for (std::uint32_t k = 0; k < raster.bits / 8; ++k) bytes.push_back(std::byte(value & 0xFFU));
    }
  }
  return bytes;
}

TranscodeRequest to_format(const std::vector<std::byte>& png, EncodedFormat format,
                           std::uint32_t quality = 0) {
  TranscodeRequest request;
  request.image.bytes = png;
  request.image.max_pixels = 1U << 20U;
  request.format = format;
  request.quality = quality;
  return request;
}

EncodedImage transcoded(const TranscodeRequest& request) {
  return test::value_of(Client::shared().transcode_image(request));
}

std::string transcode_error(const TranscodeRequest& request,
                            ErrorKind kind = ErrorKind::unsupported) {
  return test::refusal_of(Client::shared().transcode_image(request), kind);
}

Image image_in(const EncodedImage& file, ImageFormat format) {
  ImageRequest request;
  request.bytes = file.bytes;
  request.format = format;
  request.pixels = true;
  return test::value_of(Client::shared().decode_image(request));
}

int greatest_difference(std::span<const std::byte> a, std::span<const std::byte> b) {
  EXPECT_EQ(a.size(), b.size());
  int greatest = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    greatest = std::max(greatest, std::abs(static_cast<int>(a[i]) - static_cast<int>(b[i])));
  }
  return greatest;
}

TEST(Transcode, LosslessWebpKeepsColoursBelowAlphaZero) {
  const Raster raster{80, 70, 4, 8};
  const std::vector<std::byte> texels = smooth_texels(raster);
  const EncodedImage file = transcoded(to_format(png_file(raster, texels), EncodedFormat::webp));
  EXPECT_EQ(file.source, raster);
  EXPECT_EQ(file.raster, raster);
  EXPECT_EQ(greatest_difference(image_in(file, ImageFormat::webp).pixels, texels), 0);
}

TEST(Transcode, GreyBecomesRgbInWebpAndStaysGreyInPng) {
  for (const std::uint32_t channels : {1U, 2U}) {
    const Raster raster{40, 30, channels, 8};
    const std::vector<std::byte> texels = smooth_texels(raster);
    const std::vector<std::byte> png = png_file(raster, texels);
    const EncodedImage webp = transcoded(to_format(png, EncodedFormat::webp));
    EXPECT_EQ(webp.raster.channels, channels + 2);
    const Image image = image_in(webp, ImageFormat::webp);
    ASSERT_EQ(image.channels, channels + 2);
    for (std::size_t i = 0; i < std::size_t{40} * 30; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_EQ(image.pixels[i * image.channels + c], texels[i * channels]);
      }
      if (channels == 1) continue;
      ASSERT_EQ(image.pixels[i * 4 + 3], texels[i * 2 + 1]);
    }
    const EncodedImage same = transcoded(to_format(png, EncodedFormat::png));
    EXPECT_EQ(greatest_difference(image_in(same, ImageFormat::png).pixels, texels), 0);
  }
}

TEST(Transcode, OpaqueAlphaIsNoLoss) {
  const Raster raster{70, 66, 4, 8};
  const std::vector<std::byte> png = png_file(raster, smooth_texels(raster, true));
  EXPECT_GT(transcoded(to_format(png, EncodedFormat::webp)).size, 0U) << "WebP drops it";
  const EncodedImage jpeg = transcoded(to_format(png, EncodedFormat::jpeg, 90));
  EXPECT_EQ(jpeg.raster.channels, 3U);
  const std::vector<std::byte> clear = png_file(raster, smooth_texels(raster));
  EXPECT_THAT(transcode_error(to_format(clear, EncodedFormat::jpeg, 90)), HasSubstr("alpha"));
}

TEST(Transcode, SmallestPngIsNoLargerAndHoldsTheSame) {
  for (const std::uint32_t bits : {8U, 16U}) {
    for (std::uint32_t channels = 1; channels <= 4; ++channels) {
      const Raster raster{90, 61, channels, bits};
      const std::vector<std::byte> texels = smooth_texels(raster);
      const std::vector<std::byte> png = png_file(raster, texels);
      TranscodeRequest request = to_format(png, EncodedFormat::png);
      request.options.smallest = true;
      const EncodedImage small = transcoded(request);
      EXPECT_LE(small.size, png.size());
      const Image image = image_in(small, ImageFormat::png);
      EXPECT_EQ(image.bits, bits);
      EXPECT_EQ(greatest_difference(image.pixels, texels), 0);
      TranscodeRequest again = request;
      const std::vector<std::byte> first(small.bytes.begin(), small.bytes.end());
      again.image.bytes = first;
      EXPECT_TRUE(std::ranges::equal(transcoded(again).bytes, first)) << "nothing left to gain";
    }
  }
}

TEST(Transcode, SixteenBitsNeedPngOrALoss) {
  const Raster raster{64, 64, 3, 16};
  const std::vector<std::byte> png = png_file(raster, smooth_texels(raster));
  EXPECT_THAT(transcode_error(to_format(png, EncodedFormat::webp)), HasSubstr("does not support"));
  EXPECT_EQ(transcoded(to_format(png, EncodedFormat::png)).raster.bits, 16U);
  const EncodedImage webp = transcoded(to_format(png, EncodedFormat::webp, 90));
  EXPECT_EQ(webp.source.bits, 16U);
  EXPECT_EQ(webp.raster.bits, 8U);
  EXPECT_EQ(transcoded(to_format(png, EncodedFormat::jpeg, 90)).raster.bits, 8U);
  EXPECT_THAT(transcode_error(to_format(png, EncodedFormat::exr)), HasSubstr("does not support"));
}

TEST(Transcode, NearlyLosslessWebpIsSmallerAndNear) {
  const Raster raster{128, 128, 4, 8};
  const std::vector<std::byte> texels = smooth_texels(raster, true);
  const std::vector<std::byte> png = png_file(raster, texels);
  TranscodeRequest request = to_format(png, EncodedFormat::webp);
  const EncodedImage exact = transcoded(request);
  request.options.near_lossless = 60;
  const EncodedImage near = transcoded(request);
  EXPECT_LT(near.size, exact.size);
  const Image a = image_in(exact, ImageFormat::webp);
  const Image b = image_in(near, ImageFormat::webp);
  const int difference = greatest_difference(a.pixels, b.pixels);
  EXPECT_GT(difference, 0);
  EXPECT_LE(difference, 2);
  EXPECT_FALSE(exact.distance) << "it has the same texels";
  ASSERT_TRUE(near.distance);
  EXPECT_EQ(near.distance->greatest, difference);
  EXPECT_GT(near.distance->decibels(), 40);
  const std::vector<std::byte> clear = smooth_texels(raster);
  const std::vector<std::byte> file = png_file(raster, clear);
  request.image.bytes = file;
  EXPECT_LE(greatest_difference(image_in(transcoded(request), ImageFormat::webp).pixels, clear), 2)
      << "below alpha 0, too";
}

TEST(Transcode, MeasuresTheLossAgainstTheResizedSource) {
  const std::vector<std::byte> png = png_file({64, 64, 3, 16}, smooth_texels({64, 64, 3, 16}));
  TranscodeRequest request = to_format(png, EncodedFormat::jpeg, 90);
  request.image.resize.max_side = 32;
  const EncodedImage small = transcoded(request);
  ASSERT_TRUE(small.distance);
  ImageRequest source = request.image;
  source.pixels = true;
  const Image wide = test::value_of(Client::shared().decode_image(source));
  const Image narrow = image_in(small, ImageFormat::jpeg);
  ASSERT_EQ(wide.bits, 16U);
  ASSERT_EQ(wide.channels, narrow.channels);
  double squares = 0, greatest = 0;
  for (std::size_t i = 0; i < narrow.pixels.size(); ++i) {
    std::uint16_t value = 0;
    std::memcpy(&value, wide.pixels.data() + i * 2, 2);
    const double off = std::abs(value / 257.0 - static_cast<double>(narrow.pixels[i]));
    greatest = std::max(greatest, off);
    squares += off * off;
  }
  EXPECT_EQ(small.distance->greatest, greatest);
  EXPECT_NEAR(small.distance->mean_square, squares / static_cast<double>(narrow.pixels.size()),
              1e-9);
}

TEST(Transcode, JpegHalvesColoursOnlyWhereAsked) {
  // Columns of red and green become brown if colour has half the resolution.
  const Raster raster{64, 64, 3, 8};
  std::vector<std::byte> texels;
  for (unsigned i = 0; i < 64 * 64; ++i) {
    const unsigned red = i % 2 == 0 ? 200 : 60;
    for (const unsigned value : {red, 260 - red, 90U}) texels.push_back(std::byte(value));
  }
  TranscodeRequest request = to_format(png_file(raster, texels), EncodedFormat::jpeg, 95);
  const std::vector<std::byte> png = png_file(raster, texels);
  request.image.bytes = png;
  const EncodedImage halved = transcoded(request);
  request.options.subsampled = false;
  const EncodedImage whole = transcoded(request);
  EXPECT_GT(greatest_difference(image_in(halved, ImageFormat::jpeg).pixels, texels), 40);
  EXPECT_LE(greatest_difference(image_in(whole, ImageFormat::jpeg).pixels, texels), 12);
}

TEST(Transcode, ImagesAreResizedOnTheWay) {
  const Raster raster{64, 32, 4, 8};
  const std::vector<std::byte> png = png_file(raster, smooth_texels(raster));
  TranscodeRequest request = to_format(png, EncodedFormat::webp);
  request.image.resize.max_side = 16;
  const EncodedImage file = transcoded(request);
  EXPECT_EQ(file.source, raster);
  EXPECT_EQ(file.raster, (Raster{16, 8, 4, 8}));
  const Image image = image_in(file, ImageFormat::webp);
  EXPECT_EQ(image.width, 16U);
  ImageRequest pixels = request.image;
  pixels.pixels = true;
  const ImageResult same = Client::shared().decode_image(pixels);
  ASSERT_TRUE(std::holds_alternative<Image>(same));
  EXPECT_EQ(greatest_difference(image.pixels, std::get<Image>(same).pixels), 0);
}

TEST(Transcode, TheSameRequestGivesTheSameBytes) {
  const Raster raster{70, 70, 4, 8};
  const std::vector<std::byte> png = png_file(raster, smooth_texels(raster, true));
  for (const auto& [format, quality] :
       {std::pair(EncodedFormat::png, 0U), std::pair(EncodedFormat::webp, 0U),
        std::pair(EncodedFormat::webp, 80U), std::pair(EncodedFormat::jpeg, 90U)}) {
    TranscodeRequest request = to_format(png, format, quality);
    request.options.smallest = true;
    request.image.resize.max_side = 33;
    Client other;
    const EncodedImage once = transcoded(request);
    const EncodeResult twice = other.transcode_image(request);
    ASSERT_TRUE(std::holds_alternative<EncodedImage>(twice));
    EXPECT_TRUE(std::ranges::equal(once.bytes, std::get<EncodedImage>(twice).bytes));
  }
}

// It decodes, but what is missing would be grey for good.
TEST(Transcode, AJpegThatIsCutIsRefused) {
  auto jpeg = container::decode_base64(test::kJpegBase64);
  ASSERT_TRUE(jpeg);
  const auto request_for = [](const std::string& bytes) {
    TranscodeRequest request;
    request.image.bytes = std::as_bytes(std::span(bytes.data(), bytes.size()));
    request.image.format = ImageFormat::jpeg;
    request.format = EncodedFormat::png;
    return request;
  };
  EXPECT_GT(transcoded(request_for(*jpeg)).size, 0U);
  const std::string cut = jpeg->substr(0, jpeg->size() - 6);
  TranscodeRequest request = request_for(cut);
  EXPECT_THAT(transcode_error(request, ErrorKind::malformed), HasSubstr("Premature end"));
  request.image.resize.max_side = 4;
  EXPECT_THAT(transcode_error(request, ErrorKind::malformed), HasSubstr("Premature end"));
}

TEST(Transcode, ACutoffIsANumber) {
  const std::vector<std::byte> png = png_file({30, 30, 3, 8}, smooth_texels({30, 30, 3, 8}));
  TranscodeRequest request = to_format(png, EncodedFormat::png);
  request.image.resize.max_side = 4;
  request.image.resize.alpha_cutoff = std::numeric_limits<float>::quiet_NaN();
  for (const ImageFormat format : {ImageFormat::png, ImageFormat::avif, ImageFormat::tga}) {
    request.image.format = format;
    EXPECT_EQ(transcode_error(request, ErrorKind::malformed), "The alpha cutoff is not a number.");
  }
}

TEST(Transcode, BrokenImagesAndOddRequestsAreErrors) {
  const Raster raster{30, 30, 3, 8};
  std::vector<std::byte> png = png_file(raster, smooth_texels(raster));
  EXPECT_THAT(transcode_error(to_format(png, EncodedFormat::jpeg, 0)), HasSubstr("not support"));
  EXPECT_THAT(transcode_error(to_format(png, EncodedFormat::png, 101)), HasSubstr("quality"));
  TranscodeRequest large = to_format(png, EncodedFormat::png);
  large.image.max_pixels = 899;
  const EncodeResult result = Client::shared().transcode_image(large);
  ASSERT_TRUE(std::holds_alternative<DecodeError>(result));
  EXPECT_EQ(std::get<DecodeError>(result).kind, ErrorKind::too_large);
  png.resize(png.size() / 2);
  EXPECT_NE(transcode_error(to_format(png, EncodedFormat::webp), ErrorKind::malformed), "a result");
}

}  // namespace
}  // namespace gltfx::codec
