// SPDX-License-Identifier: Apache-2.0
/// Images that the worker of the build encodes and decodes again.
#include <cstring>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/client.hpp"
#include "codec/support/results.hpp"

namespace gltfx::codec {
namespace {

using testing::HasSubstr;

// Texels that no filter predicts well, rows that a filter does, and single outliers.
std::vector<std::byte> texels(const Raster& raster) {
  const std::size_t size =
      std::size_t{raster.width} * raster.height * raster.channels * (raster.bits / 8);
  std::vector<std::byte> bytes(size);
  std::uint32_t state = 1;
  for (std::size_t i = 0; i < size; ++i) {
    state = state * 1664525U + 1013904223U;
    const bool noise = i % 1000 < 300;
    bytes[i] = std::byte(noise ? state >> 24U : (i / 7 + i % 3) & 0xFFU);
  }
  return bytes;
}

EncodeResult encode(EncodedFormat format, const Raster& raster,
                    const std::vector<std::byte>& pixels, std::uint32_t quality = 90) {
  return Client::shared().encode_image({format, raster, quality, pixels});
}

std::span<const std::byte> bytes_of(const EncodeResult& result) {
  if (const auto* error = std::get_if<DecodeError>(&result)) ADD_FAILURE() << error->message;
  const auto* image = std::get_if<EncodedImage>(&result);
  return image == nullptr ? std::span<const std::byte>() : image->bytes;
}

Image decode_again(std::span<const std::byte> file, ImageFormat format) {
  ImageRequest request;
  request.bytes = file;
  request.format = format;
  request.pixels = true;
  return test::value_of(Client::shared().decode_image(request));
}

bool equal(std::span<const std::byte> a, std::span<const std::byte> b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
}

TEST(Encode, PngOfEveryFormKeepsEveryBit) {
  for (const std::uint32_t bits : {8U, 16U}) {
    for (std::uint32_t channels = 1; channels <= 4; ++channels) {
      const Raster raster{37, 29, channels, bits};
      const std::vector<std::byte> pixels = texels(raster);
      const EncodeResult result = encode(EncodedFormat::png, raster, pixels);
      const Image image = decode_again(bytes_of(result), ImageFormat::png);
      EXPECT_EQ(image.width, 37U);
      EXPECT_EQ(image.height, 29U);
      EXPECT_EQ(image.channels, channels);
      EXPECT_EQ(image.bits, bits);
      EXPECT_TRUE(equal(image.pixels, pixels)) << channels << " channels of " << bits;
    }
  }
}

TEST(Encode, TheSameTexelsBecomeTheSameBytes) {
  const Raster raster{64, 64, 4, 8};
  const std::vector<std::byte> pixels = texels(raster);
  for (const EncodedFormat format : {EncodedFormat::png, EncodedFormat::webp}) {
    const EncodeResult once = encode(format, raster, pixels);
    Client other;
    const EncodeResult twice = other.encode_image({format, raster, 90, pixels});
    EXPECT_TRUE(equal(bytes_of(once), bytes_of(twice)));
  }
}

TEST(Encode, LosslessWebpKeepsColoursOfTransparentTexels) {
  const Raster raster{16, 16, 4, 8};
  const std::vector<std::byte> pixels = texels(raster);
  const EncodeResult result = encode(EncodedFormat::webp, raster, pixels, 0);
  EXPECT_TRUE(equal(decode_again(bytes_of(result), ImageFormat::webp).pixels, pixels));
}

TEST(Encode, JpegAndLossyWebpComeNear) {
  const Raster raster{32, 32, 3, 8};
  const std::vector<std::byte> pixels(std::size_t{32} * 32 * 3, std::byte{100});
  for (const auto& [to, from] : {std::pair(EncodedFormat::jpeg, ImageFormat::jpeg),
                                 std::pair(EncodedFormat::webp, ImageFormat::webp)}) {
    const EncodeResult result = encode(to, raster, pixels);
    const Image image = decode_again(bytes_of(result), from);
    ASSERT_EQ(image.channels, 3U);
    EXPECT_NEAR(image.statistics[0].least, 100, 3);
    EXPECT_NEAR(image.statistics[0].greatest, 100, 3);
  }
}

TEST(Encode, ExrHoldsFloats) {
  const Raster raster{8, 4, 3, 32};
  const std::vector<float> values(std::size_t{8} * 4 * 3, 2.5F);
  std::vector<std::byte> pixels(values.size() * sizeof(float));
  std::memcpy(pixels.data(), values.data(), pixels.size());
  const EncodeResult result = encode(EncodedFormat::exr, raster, pixels);
  const std::span<const std::byte> file = bytes_of(result);
  ASSERT_GT(file.size(), 4U);
  EXPECT_EQ(std::memcmp(file.data(), "\x76\x2F\x31\x01", 4), 0);
  const std::string text(reinterpret_cast<const char*>(file.data()), file.size());
  EXPECT_THAT(text, testing::Not(HasSubstr("capDate"))) << "bytes would differ by time";
  EXPECT_TRUE(equal(decode_again(file, ImageFormat::openexr).pixels, pixels));
  const EncodeResult again = encode(EncodedFormat::exr, raster, pixels);
  EXPECT_TRUE(equal(file, bytes_of(again)));
}

TEST(Encode, WhatAFormatDoesNotHoldIsRefused) {
  const auto refused = [](EncodedFormat format, const Raster& raster, std::size_t size) {
    const EncodeResult result = encode(format, raster, std::vector<std::byte>(size));
    const auto* error = std::get_if<DecodeError>(&result);
    return error != nullptr && error->kind == ErrorKind::unsupported;
  };
  EXPECT_TRUE(refused(EncodedFormat::png, {1, 1, 4, 32}, 16));
  EXPECT_TRUE(refused(EncodedFormat::png, {1, 1, 4, 8}, 5));
  EXPECT_TRUE(refused(EncodedFormat::png, {0, 1, 4, 8}, 0));
  EXPECT_TRUE(refused(EncodedFormat::png, {1, 1, 5, 8}, 5));
  EXPECT_TRUE(refused(EncodedFormat::jpeg, {1, 1, 4, 8}, 4));
  EXPECT_TRUE(refused(EncodedFormat::webp, {1, 1, 3, 16}, 6));
  EXPECT_TRUE(refused(EncodedFormat::webp, {20000, 1, 3, 8}, 60000));
  EXPECT_TRUE(refused(EncodedFormat::exr, {1, 1, 3, 8}, 3));
}

}  // namespace
}  // namespace gltfx::codec
