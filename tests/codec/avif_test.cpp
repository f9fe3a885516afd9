// SPDX-License-Identifier: Apache-2.0
/// AVIF images through their worker. The tests need libavif, which tools/test installs.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/client.hpp"
#include "codec/support/results.hpp"

namespace gltfx::codec {
namespace {

using testing::HasSubstr;

std::string avif_bytes(const std::string& name) {
  std::ifstream file(GLTFX_SOURCE_DIR "/tests/codec/avif/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

ImageResult decode_avif_bytes(Client& client, const std::string& bytes,
                              std::uint64_t max_pixels = 1024) {
  ImageRequest request;
  request.bytes = std::as_bytes(std::span(bytes.data(), bytes.size()));
  request.format = ImageFormat::avif;
  request.pixels = true;
  request.max_pixels = max_pixels;
  return client.decode_image(request);
}

TEST(Avif, WithoutTheDecoderItIsNamed) {
  Settings settings;
  settings.folder = GLTFX_SOURCE_DIR;  // no programs
  Client client(settings);
  const ImageResult result = decode_avif_bytes(client, avif_bytes("rgb.avif"));
  const auto* error = std::get_if<DecodeError>(&result);
  ASSERT_NE(error, nullptr);
  EXPECT_EQ(error->kind, ErrorKind::unavailable);
  EXPECT_THAT(error->message, HasSubstr("built without libavif"));
}

Image avif_image(const std::string& name) {
  return test::value_of(decode_avif_bytes(Client::shared(), avif_bytes(name)));
}

// For the eight texels of all files.
constexpr std::array<std::array<std::uint8_t, 4>, 8> kTexels{{{200, 100, 50, 128},
                                                              {1, 2, 3, 4},
                                                              {255, 255, 255, 255},
                                                              {9, 8, 7, 64},
                                                              {0, 0, 0, 0},
                                                              {10, 20, 30, 40},
                                                              {77, 66, 55, 44},
                                                              {5, 250, 5, 250}}};

TEST(Avif, LosslessImagesAreExact) {
  for (const auto& [name, channels] : {std::pair("rgba.avif", 4U), std::pair("rgb.avif", 3U)}) {
    const Image image = avif_image(name);
    ASSERT_EQ(image.channels, channels);
    ASSERT_EQ(image.width, 4U);
    ASSERT_EQ(image.height, 2U);
    for (std::size_t i = 0; i < kTexels.size(); ++i) {
      for (std::size_t c = 0; c < channels; ++c) {
        EXPECT_EQ(std::to_integer<int>(image.pixels[i * channels + c]), kTexels[i][c]) << i;
      }
    }
  }
}

TEST(Avif, TenBitsBecomeSixteen) {
  const Image image = avif_image("deep.avif");
  ASSERT_EQ(image.bits, 16U);
  for (std::size_t i = 0; i < kTexels.size(); ++i) {
    std::uint16_t red = 0;
    std::memcpy(&red, image.pixels.data() + i * 6, sizeof red);
    EXPECT_NEAR(red, kTexels[i][0] * 257, 65535 / 1023.0);
  }
}

TEST(Avif, GreyIsGrey) { EXPECT_TRUE(avif_image("grey.avif").grey); }

TEST(Avif, DamagedFilesAreDecodedOrRefused) {
  const std::string bytes = avif_bytes("rgba.avif");
  for (std::size_t at = 0; at < bytes.size(); at += 5) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << at % 8));
    for (const std::string& file : {damaged, bytes.substr(0, at)}) {
      const ImageResult result = decode_avif_bytes(Client::shared(), file);
      const auto* error = std::get_if<DecodeError>(&result);
      if (error == nullptr) continue;
      EXPECT_TRUE(error->kind == ErrorKind::malformed || error->kind == ErrorKind::too_large ||
                  error->kind == ErrorKind::out_of_memory)
          << at << error->message;
    }
  }
}

// Another worker resizes. Without a check it would end at such a cutoff.
TEST(Avif, ACutoffIsANumber) {
  const std::string bytes = avif_bytes("rgba.avif");
  ImageRequest request;
  request.bytes = std::as_bytes(std::span(bytes.data(), bytes.size()));
  request.format = ImageFormat::avif;
  request.pixels = true;
  request.resize.max_side = 2;
  request.resize.alpha_cutoff = std::numeric_limits<float>::quiet_NaN();
  const std::uint64_t before = transient_errors();
  const ImageResult result = Client::shared().decode_image(request);
  const auto* error = std::get_if<DecodeError>(&result);
  ASSERT_NE(error, nullptr);
  EXPECT_EQ(error->kind, ErrorKind::malformed);
  EXPECT_EQ(transient_errors(), before);
  request.resize.alpha_cutoff = 0.5F;
  const ImageResult resized = Client::shared().decode_image(request);
  ASSERT_TRUE(std::holds_alternative<Image>(resized));
  EXPECT_EQ(std::get<Image>(resized).width, 2U);
  request.resize.max_side = 4;  // nothing to do
  const ImageResult same = Client::shared().decode_image(request);
  ASSERT_TRUE(std::holds_alternative<Image>(same));
  EXPECT_EQ(std::to_integer<int>(std::get<Image>(same).pixels[0]), kTexels[0][0]);
}

TEST(Avif, MoreTexelsThanAskedForAreRefused) {
  const ImageResult result = decode_avif_bytes(Client::shared(), avif_bytes("rgb.avif"), 7);
  const auto* error = std::get_if<DecodeError>(&result);
  ASSERT_NE(error, nullptr);
  EXPECT_EQ(error->kind, ErrorKind::too_large);
}

// --- Encoding ---

// A ramp in each colour; alpha is 0 or 255.
std::vector<std::byte> ramps(const Raster& raster) {
  std::vector<std::byte> texels;
  for (std::uint32_t i = 0; i < raster.width * raster.height; ++i) {
    for (std::uint32_t c = 0; c < raster.channels; ++c) {
      const bool alpha = raster.channels % 2 == 0 && c + 1 == raster.channels;
      const std::uint32_t value = alpha ? i % 3 / 2 * 255 : (i % raster.width * 2 + c * 40) % 256;
      texels.insert(texels.end(), raster.bits / 8, static_cast<std::byte>(value));
    }
  }
  return texels;
}

TranscodeRequest to_avif(const std::vector<std::byte>& png, std::uint32_t quality) {
  TranscodeRequest request;
  request.image.bytes = png;
  request.image.max_pixels = 1U << 20U;
  request.format = EncodedFormat::avif;
  request.quality = quality;
  return request;
}

EncodedImage avif_of(const TranscodeRequest& request) {
  return test::value_of(Client::shared().transcode_image(request));
}

Image image_of(const EncodedImage& file) {
  const std::string bytes(reinterpret_cast<const char*>(file.bytes.data()), file.size);
  return test::value_of(decode_avif_bytes(Client::shared(), bytes, 1U << 20U));
}

TEST(AvifEncoder, KeepsAlphaAndNearlyAllColour) {
  const Raster raster{64, 48, 4, 8};
  const std::vector<std::byte> texels = ramps(raster);
  const EncodedImage file = avif_of(to_avif(test::png_file(raster, texels), 90));
  EXPECT_EQ(file.source, raster);
  EXPECT_EQ(file.raster, raster);
  const Image image = image_of(file);
  ASSERT_EQ(image.channels, 4U);
  double squares = 0;
  double greatest = 0;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const double off = static_cast<double>(texels[i]) - static_cast<double>(image.pixels[i]);
    if (i % 4 == 3) {
      ASSERT_EQ(off, 0) << i;
    }
    squares += off * off;
    greatest = std::max(greatest, std::abs(off));
  }
  ASSERT_TRUE(file.distance);
  EXPECT_DOUBLE_EQ(file.distance->mean_square, squares / static_cast<double>(texels.size()));
  EXPECT_EQ(file.distance->greatest, greatest);
  EXPECT_GT(file.distance->decibels(), 40);
}

TEST(AvifEncoder, TakesGreyAndSixteenBits) {
  for (const Raster& raster : {Raster{16, 16, 1, 8}, Raster{16, 16, 2, 8}, Raster{16, 16, 3, 16}}) {
    const std::vector<std::byte> png = test::png_file(raster, ramps(raster));
    const EncodedImage file = avif_of(to_avif(png, 80));
    EXPECT_EQ(file.source, raster);
    EXPECT_EQ(file.raster, (Raster{16, 16, raster.channels == 2 ? 4U : 3U, 8}));
    EXPECT_EQ(image_of(file).channels, file.raster.channels);
  }
}

TEST(AvifEncoder, ResizesAndGivesTheSameBytesAgain) {
  const Raster raster{100, 60, 3, 8};
  const std::vector<std::byte> png = test::png_file(raster, ramps(raster));
  TranscodeRequest request = to_avif(png, 60);
  request.image.resize.max_side = 50;
  const EncodedImage first = avif_of(request);
  EXPECT_EQ(first.source, raster);
  EXPECT_EQ(first.raster, (Raster{50, 30, 3, 8}));
  const EncodedImage second = avif_of(request);
  EXPECT_TRUE(
      std::equal(first.bytes.begin(), first.bytes.end(), second.bytes.begin(), second.bytes.end()));
}

TEST(AvifEncoder, IsNamedIfItIsMissing) {
  Settings settings;
  settings.folder = GLTFX_SOURCE_DIR;  // no programs
  Client client(settings);
  const Raster raster{16, 16, 3, 8};
  const std::vector<std::byte> png = test::png_file(raster, ramps(raster));
  const DecodeError error = test::error_of(client.transcode_image(to_avif(png, 80)));
  EXPECT_EQ(error.kind, ErrorKind::unavailable);
  EXPECT_THAT(error.message, HasSubstr("built without libavif"));
}

}  // namespace
}  // namespace gltfx::codec
