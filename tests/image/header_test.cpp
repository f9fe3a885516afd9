// SPDX-License-Identifier: Apache-2.0
// What headers of images say, and what is wrong with them. The images are built here, byte by byte.
#include "image/header.hpp"

#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "image/png_builder.hpp"

namespace gltfx::image {
namespace {

using namespace std::literals;

using test::be32;
using test::jpeg;
using test::jpeg_frame;
using test::jpeg_segment;
using test::png;
using test::png_chunk;
using test::PngHeader;
using test::webp;

HeaderResult read(const std::string& bytes) {
  return read_header(std::as_bytes(std::span(bytes.data(), bytes.size())));
}

Header header(const std::string& bytes) {
  const HeaderResult result = read(bytes);
  const auto* found = std::get_if<Header>(&result);
  EXPECT_NE(found, nullptr);
  return found != nullptr ? *found : Header{};
}

HeaderFault::Kind fault(const std::string& bytes) {
  const HeaderResult result = read(bytes);
  const auto* found = std::get_if<HeaderFault>(&result);
  EXPECT_NE(found, nullptr);
  return found != nullptr ? found->kind : HeaderFault::Kind::unrecognized;
}

TEST(Sniff, FourFormatsByTheirFirstBytes) {
  const auto format = [](std::string bytes) {
    bytes.resize(kSniffBytes, '\0');
    const Sniffed found = sniff(std::as_bytes(std::span(bytes.data(), bytes.size())));
    return found.known ? std::string(media_type(found.format)) : std::string();
  };
  EXPECT_EQ(format("\x89PNG\r\n\x1a\n"), "image/png");
  EXPECT_EQ(format("\xff\xd8\xff"), "image/jpeg");
  EXPECT_EQ(format("RIFF....WEBPVP"), "image/webp");
  EXPECT_EQ(format("\xabKTX 20\xbb\r\n\x1a\n"), "image/ktx2");
  EXPECT_EQ(format("RIFF....WAVE"), "");
  EXPECT_EQ(format("\x89PNG\n\x1a\n"), "");
  EXPECT_EQ(format("GIF89a"), "");
}

TEST(Sniff, FewerBytesThanAnyImageHasAreUnknown) {
  const std::string whole = png();
  for (std::size_t size = 0; size < kSniffBytes; ++size) {
    EXPECT_EQ(fault(whole.substr(0, size)), HeaderFault::Kind::unrecognized) << size;
  }
}

TEST(Png, SizeAndChannels) {
  const Header found = header(png({}, {300, 200, 16, 6, 1}));
  EXPECT_EQ(found.width, 300U);
  EXPECT_EQ(found.height, 200U);
  EXPECT_EQ(found.bits, 16U);
  EXPECT_EQ(found.channels, Channels::rgba);
  EXPECT_TRUE(found.interlaced);
  EXPECT_EQ(header(png({}, {1, 1, 8, 0, 0})).channels, Channels::luminance);
  EXPECT_EQ(header(png({}, {1, 1, 8, 2, 0})).channels, Channels::rgb);
  EXPECT_EQ(header(png({}, {1, 1, 8, 4, 0})).channels, Channels::luminance_alpha);
  const Header palette = header(png({}, {1, 1, 8, 3, 0}));
  EXPECT_EQ(palette.channels, Channels::rgb);
  EXPECT_TRUE(palette.palette);
}

TEST(Png, TransparentColourMakesAnAlphaChannel) {
  const std::string transparent = png_chunk("tRNS", "ab");
  EXPECT_EQ(header(png(transparent, {1, 1, 8, 0, 0})).channels, Channels::luminance_alpha);
  EXPECT_EQ(header(png(transparent, {1, 1, 8, 2, 0})).channels, Channels::rgba);
  EXPECT_EQ(header(png(transparent, {1, 1, 8, 3, 0})).channels, Channels::rgba);
}

TEST(Png, WithoutAWordAboutColourItIsSrgb) {
  EXPECT_EQ(header(png()).primaries, Tag::srgb);
  EXPECT_EQ(header(png()).transfer, Tag::srgb);
}

TEST(Png, Gamma) {
  const auto transfer = [](std::uint32_t gamma) {
    return header(png(png_chunk("gAMA", be32(gamma)))).transfer;
  };
  EXPECT_EQ(transfer(45455), Tag::srgb);
  EXPECT_EQ(transfer(100000), Tag::linear);
  EXPECT_EQ(transfer(45454), Tag::custom);
}

TEST(Png, Chromaticities) {
  std::string values;
  for (const std::uint32_t value :
       {31270U, 32900U, 64000U, 33000U, 30000U, 60000U, 15000U, 6000U}) {
    values += be32(value);
  }
  EXPECT_EQ(header(png(png_chunk("cHRM", values))).primaries, Tag::srgb);
  values.back() = '\0';
  EXPECT_EQ(header(png(png_chunk("cHRM", values))).primaries, Tag::custom);
}

TEST(Png, SrgbAndProfilesOverrideGamma) {
  const std::string gamma = png_chunk("gAMA", be32(1));
  const std::string srgb = png_chunk("sRGB", std::string(1, '\0'));
  const std::string profile = png_chunk("iCCP", "profile");
  EXPECT_EQ(header(png(gamma + srgb)).transfer, Tag::srgb);
  EXPECT_EQ(header(png(srgb + gamma)).transfer, Tag::srgb);
  EXPECT_EQ(header(png(png_chunk("gAMA", be32(100000)) + profile)).transfer, Tag::custom);
  EXPECT_EQ(header(png(profile + png_chunk("gAMA", be32(100000)))).transfer, Tag::custom);
  EXPECT_EQ(header(png(profile)).primaries, Tag::custom);
}

TEST(Png, PixelsThatAreNotSquare) {
  const auto square = [](std::uint32_t x, std::uint32_t y) {
    return header(png(png_chunk("pHYs", be32(x) + be32(y) + '\1'))).square_pixels;
  };
  EXPECT_TRUE(square(300, 300));
  EXPECT_FALSE(square(300, 301));
}

TEST(Png, AnimationIsTold) {
  EXPECT_TRUE(header(png(png_chunk("acTL", "12345678"))).animated);
  EXPECT_FALSE(header(png()).animated);
}

TEST(Png, ChunksOfOneLengthHaveIt) {
  for (const char* type : {"gAMA", "cHRM", "sRGB", "pHYs", "IHDR"}) {
    EXPECT_EQ(fault(png(png_chunk(type, "12"))), HeaderFault::Kind::invalid) << type;
  }
}

TEST(Png, BeginsWithItsHeader) {
  std::string bytes = png();
  bytes.replace(bytes.find("IHDR"), 4, "JHDR");
  EXPECT_EQ(fault(bytes), HeaderFault::Kind::invalid);
}

TEST(Png, HeadersThatCannotBeMeantAreDoubted) {
  EXPECT_TRUE(header(png()).doubt.empty());
  EXPECT_FALSE(header(png({}, {0, 1, 8, 2, 0})).doubt.empty());
  EXPECT_FALSE(header(png({}, {1, 0, 8, 2, 0})).doubt.empty());
  EXPECT_FALSE(header(png({}, {1, 1, 3, 2, 0})).doubt.empty());
  EXPECT_FALSE(header(png({}, {1, 1, 8, 5, 0})).doubt.empty());
}

TEST(Png, EveryCutBeforeTheImageDataIsAnUnexpectedEnd) {
  const std::string whole = png(png_chunk("gAMA", be32(45455)));
  const std::size_t enough = whole.find("IDAT") + 4;
  for (std::size_t size = kSniffBytes; size < enough; ++size) {
    EXPECT_EQ(fault(whole.substr(0, size)), HeaderFault::Kind::unexpected_end) << size;
  }
  EXPECT_EQ(header(whole.substr(0, enough)).width, 4U);
}

TEST(Png, AChunkOfFourGigabytesIsAnEndAndNoAllocation) {
  std::string bytes = png(png_chunk("tEXt", "x"));
  bytes.replace(bytes.find("tEXt") - 4, 4, "\xff\xff\xff\xff");
  EXPECT_EQ(fault(bytes), HeaderFault::Kind::unexpected_end);
}

TEST(Jpeg, SizeAndChannels) {
  const Header grey = header(jpeg(jpeg_frame(1)));
  EXPECT_EQ(grey.channels, Channels::luminance);
  EXPECT_EQ(grey.width, 32U);
  EXPECT_EQ(grey.height, 16U);
  EXPECT_EQ(grey.bits, 8U);
  EXPECT_EQ(grey.transfer, Tag::none);
  EXPECT_EQ(header(jpeg(jpeg_frame(3))).channels, Channels::rgb);
  EXPECT_EQ(fault(jpeg(jpeg_frame(4))), HeaderFault::Kind::invalid);
}

TEST(Jpeg, ProgressiveFramesAreInterlaced) {
  EXPECT_TRUE(header(jpeg(jpeg_frame(3, 0xC2))).interlaced);
  EXPECT_FALSE(header(jpeg(jpeg_frame(3, 0xC1))).interlaced);
}

TEST(Jpeg, TablesAreNoFrames) {
  for (const int marker : {0xC4, 0xC8, 0xCC, 0xDB}) {
    const std::string table = jpeg_segment(static_cast<unsigned char>(marker), "table");
    EXPECT_EQ(header(jpeg(table + jpeg_frame(3))).width, 32U) << marker;
  }
}

TEST(Jpeg, FillBytesAndRestartMarkersAreSkipped) {
  EXPECT_EQ(header(jpeg("\xff\xff\xff\xd0" + jpeg_frame(3))).width, 32U);
}

TEST(Jpeg, ASegmentShorterThanItsLengthFieldIsInvalid) {
  EXPECT_EQ(fault(jpeg(std::string("\xff\xe1\x00\x01", 4) + jpeg_frame(3))),
            HeaderFault::Kind::invalid);
}

TEST(Jpeg, EveryCutBeforeTheFrameEndsIsAnUnexpectedEnd) {
  const std::string whole = jpeg(jpeg_frame(3));
  for (std::size_t size = kSniffBytes; size < whole.size(); ++size) {
    EXPECT_EQ(fault(whole.substr(0, size)), HeaderFault::Kind::unexpected_end) << size;
  }
}

TEST(Webp, LossyLosslessAndExtended) {
  const Header lossy = header(webp("VP8 ", "abc\x9d\x01\x2a\x40\x41\x20\x80"s));
  EXPECT_EQ(lossy.width, 0x140U);
  EXPECT_EQ(lossy.height, 0x20U);
  EXPECT_EQ(lossy.channels, Channels::rgb);
  const Header lossless = header(webp("VP8L", "\x2f\xff\xc0\x1f\x10"s));
  EXPECT_EQ(lossless.width, 256U);
  EXPECT_EQ(lossless.height, 128U);
  EXPECT_EQ(lossless.channels, Channels::rgba);
  const Header extended = header(webp("VP8X", "\x32\0\0\0\x07\0\0\x03\0\x01"s));
  EXPECT_EQ(extended.width, 8U);
  EXPECT_EQ(extended.height, 0x10004U);
  EXPECT_EQ(extended.channels, Channels::rgba);
  EXPECT_TRUE(extended.animated);
  EXPECT_EQ(extended.primaries, Tag::custom);
}

TEST(Webp, NeedsThirtyBytesOrTwentyFive) {
  const std::string lossy = webp("VP8 ", "abc\x9d\x01\x2a\x40\x41\x20\x80"s);
  const std::string lossless = webp("VP8L", "\x2f\xff\xc0\x1f\x10"s);
  EXPECT_EQ(fault(lossy.substr(0, 29)), HeaderFault::Kind::unexpected_end);
  EXPECT_EQ(header(lossy).bits, 8U);
  EXPECT_EQ(fault(lossless.substr(0, 24)), HeaderFault::Kind::unexpected_end);
  EXPECT_EQ(header(lossless).bits, 8U);
  EXPECT_EQ(fault(webp("VPxx", std::string(20, '\0'))), HeaderFault::Kind::invalid);
}

TEST(Webp, WithoutPixelsIsDoubted) {
  EXPECT_FALSE(header(webp("VP8 ", "abc\x9d\x01\x2a\0\x40\x20\x80"s)).doubt.empty());
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

TEST(Webp, WrongSignaturesAreDoubted) {
  EXPECT_FALSE(header(webp("VP8L", std::string(20, '\0'))).doubt.empty());
  EXPECT_FALSE(header(webp("VP8 ", std::string(20, '\0'))).doubt.empty());
}

TEST(Ktx2, IsToldAndNotRead) {
  EXPECT_EQ(fault("\xabKTX 20\xbb\r\n\x1a\n" + std::string(80, '\0')),
            HeaderFault::Kind::unrecognized);
}

}  // namespace
}  // namespace gltfx::image
