// SPDX-License-Identifier: Apache-2.0
/// Images decoded by the worker of the build.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/client.hpp"
#include "codec/support/jpeg_bytes.hpp"
#include "codec/support/png_encoder.hpp"
#include "codec/support/results.hpp"
#include "container/base64.hpp"

namespace gltfx::codec {
namespace {

using test::encode_png;
using test::PngColor;
using test::PngImage;
using testing::HasSubstr;

// 2 x 2 texels: (200, 100, 50, 128), (1, 2, 3, 4), white, (9, 8, 7, 64); lossless.
constexpr std::string_view kWebp =
    "UklGRkYAAABXRUJQVlA4TDkAAAAvAUAAEB+goG0bph/l+NMYDTENsbn0LyQaBWkbMN1xM//6pqZtA+YKqy7+pBr/"
    "b8qsrg0/QIjo"
    "fwgA";
// Two frames with these texels.
constexpr std::string_view kAnimation =
    "UklGRtgAAABXRUJQVlA4WAoAAAASAAAAAQAAAQAAQU5JTQYAAAAAAAAAAABBTk1GUgAAAAAAAAAAAAEAAAEAAGQAAAJWUD"
    "hMOQAA"
    "AC8BQAAQH6CgbRumH+X40xgNMQ2xufQvJBoFaRsw3XEz//qmpm0D5gqrLv6kGv9vyqyuDT9AiOh/"
    "CABBTk1GUgAAAAAAAAAAAAEA"
    "AAEAAGQAAAJWUDhMOQAAAC8BQAAQH6CgbRumH+X40xgNMQ2xufQvJBoFaRsw3XEz//"
    "qmpm0D5gqrLv6kGv9vyqyuDT9AiOh/CAA=";

struct Wanted {
  ImageFormat format = ImageFormat::png;
  bool pixels = true;
  bool normals = false;
  std::uint64_t max_pixels = std::uint64_t{1} << 28U;
  std::uint32_t halvings = 0;
};

ImageResult decode(const std::string& bytes, const Wanted& wanted = {}) {
  ImageRequest request;
  request.bytes = std::as_bytes(std::span(bytes.data(), bytes.size()));
  request.format = wanted.format;
  request.pixels = wanted.pixels;
  request.normals = wanted.normals;
  request.max_pixels = wanted.max_pixels;
  request.halvings = wanted.halvings;
  return Client::shared().decode_image(request);
}

Image image_of(const std::string& bytes, const Wanted& wanted = {}) {
  return test::value_of(decode(bytes, wanted));
}

DecodeError error_of(const std::string& bytes, const Wanted& wanted = {}) {
  return test::error_of(decode(bytes, wanted));
}

std::string text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string decoded(std::string_view base64) {
  auto bytes = container::decode_base64(base64);
  return bytes ? *std::move(bytes) : std::string();
}

TEST(Images, AlphaIsNotMultipliedIntoColours) {
  const std::string texels = "\xC8\x64\x32\x80";
  const Image image = image_of(encode_png({1, 1, PngColor::rgba, 8, texels, {}}));
  EXPECT_EQ(image.channels, 4U);
  EXPECT_EQ(text(image.pixels), texels);
  const std::string all("\xC8\x64\x32\x80\x01\x02\x03\x04\xFF\xFF\xFF\xFF\x09\x08\x07\x40", 16);
  EXPECT_EQ(text(image_of(decoded(kWebp), {ImageFormat::webp}).pixels), all);
}

TEST(Images, OfAnAnimationTheFirstFrameCounts) {
  const Image image = image_of(decoded(kAnimation), {ImageFormat::webp});
  EXPECT_EQ(image.texels(), 4U);
  EXPECT_EQ(text(image.pixels).substr(0, 4), "\xC8\x64\x32\x80");
}

TEST(Images, AJpegHasThreeChannels) {
  const Image image = image_of(decoded(test::kJpegBase64), {ImageFormat::jpeg});
  EXPECT_EQ(image.texels(), 64U);
  EXPECT_EQ(image.channels, 3U);
  EXPECT_EQ(image.statistics[0].least, 200U);
  EXPECT_TRUE(image.statistics[2].constant());
  EXPECT_EQ(image.doubt, "");
}

// The average colour does not change.
TEST(Images, AJpegIsDecodedWithFewerTexels) {
  Wanted wanted{ImageFormat::jpeg};
  const auto mean_red = [](const Image& image) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
      sum += std::to_integer<int>(image.pixels[i]);
    }
    return sum / static_cast<double>(image.texels());
  };
  const double whole = mean_red(image_of(decoded(test::kJpegBase64), wanted));
  for (const auto& [halvings, side] :
       {std::pair(1U, 4U), std::pair(2U, 2U), std::pair(3U, 1U), std::pair(9U, 1U)}) {
    wanted.halvings = halvings;
    const Image image = image_of(decoded(test::kJpegBase64), wanted);
    EXPECT_EQ(image.width, side);
    EXPECT_EQ(image.height, side);
    EXPECT_NEAR(mean_red(image), whole, 3);
  }
}

TEST(Images, AJpegThatEndsTooEarlyIsDoubtful) {
  std::string bytes = decoded(test::kJpegBase64);
  bytes.resize(bytes.size() - 6);
  EXPECT_THAT(image_of(bytes, {ImageFormat::jpeg}).doubt, HasSubstr("Premature end"));
}

// 8 x 8 grey texels, whose first coefficient is refined many times.
std::string jpeg_of_scans(std::size_t scans) {
  std::string bytes("\xFF\xD8\xFF\xDB\0\x43\0", 7);
  bytes += std::string(64, '\1');
  bytes += std::string("\xFF\xC2\0\x0B\x08\0\x08\0\x08\1\1\x11\0", 13);
  bytes += std::string("\xFF\xC4\0\x14\0\1", 6) + std::string(16, '\0');
  bytes += std::string("\xFF\xDA\0\x08\1\1\0\0\0\1\0", 11);
  for (std::size_t i = 1; i < scans; ++i) {
    bytes += std::string("\xFF\xDA\0\x08\1\1\0\0\0\x10\0", 11);
  }
  return bytes + "\xFF\xD9";
}

TEST(Images, AJpegOfThousandsOfScansIsRefused) {
  EXPECT_EQ(image_of(jpeg_of_scans(20), {ImageFormat::jpeg}).texels(), 64U);
  const DecodeError error = error_of(jpeg_of_scans(5000), {ImageFormat::jpeg});
  EXPECT_EQ(error.kind, ErrorKind::timed_out);
  EXPECT_EQ(error.message, "It has 5000 scans; more than 500 take too long to decode.");
}

TEST(Images, SixteenBitsStaySixteenBits) {
  const Image image =
      image_of(encode_png({2, 1, PngColor::grey, 16, std::string("\x12\x34\xFF\xFF", 4), {}}));
  EXPECT_EQ(image.bits, 16U);
  EXPECT_EQ(image.channels, 1U);
  EXPECT_EQ(image.statistics[0].least, 0x1234U);
  EXPECT_EQ(image.statistics[0].fulls, 1U);
}

TEST(Images, PalettesAreResolved) {
  const std::string palette = test::png_encoder::chunk("PLTE", std::string("\1\2\3\4\5\6", 6));
  const std::string alpha = test::png_encoder::chunk("tRNS", std::string("\x10", 1));
  const std::string texels("\0\1", 2);
  const Image plain = image_of(encode_png({2, 1, PngColor::palette, 8, texels, palette}));
  EXPECT_EQ(text(plain.pixels), "\1\2\3\4\5\6");
  const Image clear = image_of(encode_png({2, 1, PngColor::palette, 8, texels, palette + alpha}));
  EXPECT_EQ(text(clear.pixels), std::string("\1\2\3\x10\4\5\6\xFF", 8));
  EXPECT_TRUE(clear.has_alpha());
}

TEST(Images, PixelsAreOnlyHandedOverWhenAskedFor) {
  Wanted wanted;
  wanted.pixels = false;
  const Image image = image_of(encode_png({1, 1, PngColor::rgb, 8, "\1\2\3", {}}), wanted);
  EXPECT_TRUE(image.pixels.empty());
  EXPECT_EQ(image.statistics[1].greatest, 2U);
}

TEST(Images, NormalsAreLookedAtWhenAskedFor) {
  Wanted wanted;
  wanted.normals = true;
  const Image image =
      image_of(encode_png({2, 1, PngColor::rgb, 8, "\x80\x80\xFF\x80\x80\x81", {}}), wanted);
  EXPECT_EQ(image.normals.vectors, 2U);
  EXPECT_EQ(image.normals.not_unit, 1U);
  EXPECT_NEAR(image.normals.mean_length, 0.5, 0.01);
}

TEST(Images, GreyTexelsOfANormalMapAreNoNormals) {
  Wanted wanted;
  wanted.normals = true;
  const std::string texels("\x80\x80\xFF\0\0\0\x80\x80\x80\xFF\xFF\xFF", 12);
  const Image image = image_of(encode_png({4, 1, PngColor::rgb, 8, texels, {}}), wanted);
  EXPECT_EQ(image.normals.vectors, 1U);
  EXPECT_EQ(image.normals.not_unit, 0U);
  EXPECT_EQ(image.normals.inward, 0U);
  EXPECT_LT(image.normals.steepest, 0.01);
}

TEST(Images, TheFormatIsTheDeclaredOne) {
  const std::string png = encode_png({1, 1, PngColor::rgb, 8, "\1\2\3", {}});
  EXPECT_EQ(error_of(png, {ImageFormat::jpeg}).kind, ErrorKind::malformed);
  EXPECT_EQ(error_of(png, {ImageFormat::webp}).kind, ErrorKind::malformed);
  EXPECT_EQ(error_of(decoded(test::kJpegBase64)).kind, ErrorKind::malformed);
}

TEST(Images, TooManyTexelsAreNotDecoded) {
  // A header with 65535 x 65535 texels.
  const PngImage bomb{65535, 65535, PngColor::rgba, 8, {}, {}};
  EXPECT_EQ(error_of(encode_png(PngImage{bomb}), {}).kind, ErrorKind::too_large);
  Wanted small;
  small.max_pixels = 3;
  EXPECT_EQ(error_of(decoded(kWebp), {ImageFormat::webp, true, false, 3}).kind,
            ErrorKind::too_large);
  EXPECT_EQ(error_of(encode_png({2, 2, PngColor::grey, 8, "1234", {}}), small).kind,
            ErrorKind::too_large);
}

TEST(Images, AnImageThatTakesTooMuchMemoryOrTimeIsRefused) {
  PngImage bomb{16384, 16384, PngColor::rgba, 16, {}, {}};
  bomb.interlaced = true;  // it is kept as a whole
  Wanted wanted;
  wanted.pixels = false;
  // Either limit may be reached first: a slow machine needs longer for the memory.
  EXPECT_THAT(error_of(encode_png(bomb), wanted).kind,
              testing::AnyOf(ErrorKind::out_of_memory, ErrorKind::timed_out));
}

// A truncated image must be complete, or have a doubt.
TEST(Images, EveryCutIsAnErrorOrDoubtedOrLosesNoPixel) {
  for (const ImageFormat format : {ImageFormat::png, ImageFormat::jpeg, ImageFormat::webp}) {
    const std::string whole =
        format == ImageFormat::png
            ? encode_png({2, 1, PngColor::rgb, 8, "\1\2\3\4\5\6", {}})
            : decoded(format == ImageFormat::jpeg ? test::kJpegBase64 : kAnimation);
    const std::string pixels = text(image_of(whole, {format}).pixels);
    for (std::size_t size = 0; size < whole.size(); size += size < 60 ? 1 : 7) {
      const ImageResult result = decode(whole.substr(0, size), {format});
      if (const auto* error = std::get_if<DecodeError>(&result)) {
        EXPECT_EQ(error->kind, ErrorKind::malformed) << size << ": " << error->message;
        continue;
      }
      const Image& image = std::get<Image>(result);
      EXPECT_TRUE(!image.doubt.empty() || text(image.pixels) == pixels) << size;
    }
  }
}

}  // namespace
}  // namespace gltfx::codec
