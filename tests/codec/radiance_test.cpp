// SPDX-License-Identifier: Apache-2.0
/// Radiance images decoded by the worker of the build.
#include <cstring>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/client.hpp"
#include "codec/support/results.hpp"

namespace gltfx::codec {
namespace {

using namespace std::string_literals;
using testing::HasSubstr;

ImageResult decode_radiance(const std::string& bytes) {
  ImageRequest request;
  request.bytes = std::as_bytes(std::span(bytes));
  request.format = ImageFormat::radiance;
  request.pixels = true;
  return Client::shared().decode_image(request);
}

std::string picture(const std::string& size, const std::string& texels) {
  return "#?RADIANCE\n# made by a test\nFORMAT=32-bit_rle_rgbe\n\n" + size + "\n" + texels;
}

std::vector<float> values_of(const std::string& bytes) {
  const Image image = test::value_of(decode_radiance(bytes));
  EXPECT_EQ(image.channels, 3U);
  EXPECT_EQ(image.bits, 32U);
  std::vector<float> values(image.pixels.size() / sizeof(float));
  std::memcpy(values.data(), image.pixels.data(), image.pixels.size());
  return values;
}

std::string message_of(const std::string& bytes) {
  return test::refusal_of(decode_radiance(bytes));
}

TEST(Radiance, MantissasHaveACommonExponent) {
  EXPECT_EQ(values_of(picture("-Y 1 +X 3", "\x80\x40\x20\x81\x01\x02\x03\x88\xFF\xFF\xFF\0"s)),
            (std::vector<float>{1, 0.5, 0.25, 1, 2, 3, 0, 0, 0}));
}

TEST(Radiance, RunsInTheOldFormRepeatATexel) {
  const std::string texels = "\x01\x02\x03\x88\x01\x01\x01\x03\x04\x05\x06\x88"s;
  EXPECT_EQ(values_of(picture("-Y 1 +X 5", texels)),
            (std::vector<float>{1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 4, 5, 6}));
  // The second of two runs counts 256 times as much.
  const std::string longer = "\x01\x02\x03\x88\x01\x01\x01\x02\x01\x01\x01\x01"s;
  const std::vector<float> values = values_of(picture("-Y 1 +X 259", longer));
  ASSERT_EQ(values.size(), 259U * 3);
  EXPECT_EQ(values[258 * 3 + 2], 3);
}

TEST(Radiance, RunsInTheNewFormAreByComponent) {
  const std::string row = "\x02\x02\0\x08"s + "\x88\x01"s + "\x08\1\2\3\4\5\6\7\x08"s +
                          "\x84\x05\x84\x06"s + "\x88\x88"s;
  const std::vector<float> values = values_of(picture("-Y 2 +X 8", row + row));
  ASSERT_EQ(values.size(), 48U);
  for (const std::size_t at : {std::size_t{0}, std::size_t{24}}) {
    EXPECT_EQ(values[at], 1);
    EXPECT_EQ(values[at + 3 * 7 + 1], 8);
    EXPECT_EQ(values[at + 3 * 3 + 2], 5);
    EXPECT_EQ(values[at + 3 * 4 + 2], 6);
  }
}

TEST(Radiance, WhatIsNoPictureIsRefused) {
  EXPECT_THAT(message_of(""), HasSubstr("header"));
  EXPECT_THAT(message_of("P6\n\n-Y 1 +X 1\n...."), HasSubstr("not a Radiance picture"));
  EXPECT_THAT(message_of("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n...."),
              HasSubstr("RGBE"));
  EXPECT_THAT(message_of(picture("+X 1 -Y 1", "....")), HasSubstr("order"));
  EXPECT_THAT(message_of(picture("-Y 0 +X 1", "....")), HasSubstr("size"));
  EXPECT_THAT(message_of(picture("-Y 1 +X 99999999999", "....")), HasSubstr("size"));
}

TEST(Radiance, RunsBeyondARowAreRefused) {
  EXPECT_THAT(message_of(picture("-Y 1 +X 3", "\x01\x02\x03\x88\x01\x01\x01\x09"s)),
              HasSubstr("too long"));
  EXPECT_THAT(message_of(picture("-Y 1 +X 3", "\x01\x01\x01\x01"s)), HasSubstr("too long"));
  EXPECT_THAT(message_of(picture("-Y 1 +X 8", "\x02\x02\0\x08\xFF\x01"s)), HasSubstr("too long"));
  EXPECT_THAT(message_of(picture("-Y 1 +X 8", "\x02\x02\0\x08\0"s)), HasSubstr("too long"));
  EXPECT_THAT(message_of(picture("-Y 1 +X 8", "\x02\x02\0\x09"s)), HasSubstr("wrong width"));
}

TEST(Radiance, EveryCutIsRefused) {
  const std::string row = "\x02\x02\0\x08\x88\x01\x88\x02\x88\x03\x88\x88"s;
  const std::string whole = picture("-Y 1 +X 8", row);
  EXPECT_EQ(message_of(whole), "a result");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(message_of(whole.substr(0, size)), "a result") << size;
  }
}

}  // namespace
}  // namespace gltfx::codec
