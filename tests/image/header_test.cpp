// SPDX-License-Identifier: Apache-2.0
// Recognition of image formats, and properties that headers of several formats share.
#include "image/header.hpp"

#include <string>

#include <gtest/gtest.h>

#include "image/headers.hpp"

namespace gltfx::image {
namespace {

using namespace std::literals;

using test::error;
using test::header;
using test::jpeg;
using test::jpeg_frame;
using test::jpeg_segment;
using test::png;
using test::png_chunk;
using test::webp;

TEST(Sniff, FiveFormatsByTheirFirstBytes) {
  const auto format = [](std::string bytes) {
    bytes.resize(kSniffBytes, '\0');
    const Sniffed found = sniff(std::as_bytes(std::span(bytes.data(), bytes.size())));
    return found.known ? std::string(media_type(found.format)) : std::string();
  };
  EXPECT_EQ(format("\x89PNG\r\n\x1a\n"), "image/png");
  EXPECT_EQ(format("\xff\xd8\xff"), "image/jpeg");
  EXPECT_EQ(format("RIFF....WEBPVP"), "image/webp");
  EXPECT_EQ(format("\xabKTX 20\xbb\r\n\x1a\n"), "image/ktx2");
  EXPECT_EQ(format("....ftypavif"), "image/avif");
  EXPECT_EQ(format("....ftypheic"), "");
  EXPECT_EQ(format("RIFF....WAVE"), "");
  EXPECT_EQ(format("\x89PNG\n\x1a\n"), "");
  EXPECT_EQ(format("GIF89a"), "");
}

TEST(Sniff, FewerBytesThanAnyImageHasAreUnknown) {
  const std::string whole = png();
  for (std::size_t size = 0; size < kSniffBytes; ++size) {
    EXPECT_EQ(error(whole.substr(0, size)), HeaderError::Kind::unrecognized) << size;
  }
}

TEST(Headers, TellWhetherAnImageIsGrey) {
  const auto palette = [](const std::string& colors) {
    return header(png(png_chunk("PLTE", colors), {4, 4, 8, 3, 0}));
  };
  EXPECT_TRUE(header(png({}, {4, 4, 8, 0, 0})).grey);
  EXPECT_TRUE(header(png({}, {4, 4, 8, 4, 0})).grey);
  EXPECT_FALSE(header(png({}, {4, 4, 8, 2, 0})).grey);
  EXPECT_TRUE(palette("\1\1\1\x80\x80\x80").grey);
  EXPECT_FALSE(palette("\1\1\1\x80\x80\x81").grey);
  EXPECT_FALSE(header(png({}, {4, 4, 8, 3, 0})).grey) << "a palette without colours";
  EXPECT_TRUE(header(jpeg(jpeg_frame(1))).grey);
  EXPECT_FALSE(header(jpeg(jpeg_frame(3))).grey);
}

TEST(Headers, TellWhetherAPaletteIsOpaque) {
  const auto entries = [](const std::string& alphas) {
    return header(
        png(png_chunk("PLTE", "\1\2\3\4\5\6") + png_chunk("tRNS", alphas), {4, 4, 8, 3, 0}));
  };
  EXPECT_TRUE(entries("\xff\xff").opaque);
  EXPECT_FALSE(can_be_transparent(entries("\xff")));
  EXPECT_FALSE(entries("\xff\xfe").opaque);
  EXPECT_TRUE(can_be_transparent(entries("\xff\xfe")));
  const Header key = header(png(png_chunk("tRNS", std::string(6, '\xff'))));
  EXPECT_TRUE(can_be_transparent(key)) << "a colour, not an alpha";
}

TEST(Headers, TellWhetherThereIsOnlyBlackAndWhite) {
  const auto palette = [](const std::string& colors) {
    return header(png(png_chunk("PLTE", colors), {4, 4, 8, 3, 0})).two_level;
  };
  EXPECT_TRUE(header(png({}, {4, 4, 1, 0, 0})).two_level);
  EXPECT_FALSE(header(png({}, {4, 4, 2, 0, 0})).two_level);
  EXPECT_TRUE(palette("\0\xff\0\xff\xff\xff"s));
  EXPECT_FALSE(palette("\0\xff\0\xff\xff\xfe"s));
}

TEST(Headers, TellColourProfiles) {
  EXPECT_TRUE(header(jpeg(jpeg_segment(0xE2, "ICC_PROFILE....") + jpeg_frame(3))).icc_profile);
  EXPECT_FALSE(header(jpeg(jpeg_segment(0xE2, "MPF.") + jpeg_frame(3))).icc_profile);
  EXPECT_TRUE(header(png(png_chunk("iCCP", "name"))).icc_profile);
  EXPECT_TRUE(header(webp("VP8X", "\x20\0\0\0\x07\0\0\x03\0\x01"s)).icc_profile);
}

TEST(Ktx2, IsToldAndNotRead) {
  EXPECT_EQ(error("\xabKTX 20\xbb\r\n\x1a\n" + std::string(80, '\0')),
            HeaderError::Kind::unrecognized);
}

}  // namespace
}  // namespace gltfx::image
