// SPDX-License-Identifier: Apache-2.0
// Contents and errors of PNG headers. The images are built here, chunk by chunk.
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "image/header.hpp"
#include "image/headers.hpp"

namespace gltfx::image {
namespace {

using test::be32;
using test::doubt;
using test::error;
using test::header;
using test::png;
using test::png_chunk;
using test::remark;

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
    EXPECT_EQ(error(png(png_chunk(type, "12"))), HeaderError::Kind::invalid) << type;
  }
}

TEST(Png, BeginsWithItsHeader) {
  std::string bytes = png();
  bytes.replace(bytes.find("IHDR"), 4, "JHDR");
  EXPECT_EQ(error(bytes), HeaderError::Kind::invalid);
}

TEST(Png, HeadersThatCannotBeMeantAreDoubted) {
  EXPECT_TRUE(header(png()).doubt.empty());
  EXPECT_FALSE(header(png({}, {0, 1, 8, 2, 0})).doubt.empty());
  EXPECT_FALSE(header(png({}, {1, 0, 8, 2, 0})).doubt.empty());
  EXPECT_FALSE(header(png({}, {1, 1, 3, 2, 0})).doubt.empty());
  EXPECT_FALSE(header(png({}, {1, 1, 8, 5, 0})).doubt.empty());
}

TEST(Png, BitDepthsGoWithColourTypes) {
  const std::string palette = png_chunk("PLTE", "\1\2\3");
  const auto sound = [&](char type, char depth) {
    return doubt(png(type == 3 ? palette : std::string(), {1, 1, depth, type})).empty();
  };
  const std::set<std::pair<int, int>> possible{{0, 1}, {0, 2},  {0, 4},  {0, 8}, {0, 16},
                                               {2, 8}, {2, 16}, {3, 1},  {3, 2}, {3, 4},
                                               {3, 8}, {4, 8},  {4, 16}, {6, 8}, {6, 16}};
  for (char type = 0; type < 8; ++type) {
    for (char depth = 0; depth <= 32; ++depth) {
      EXPECT_EQ(sound(type, depth), possible.count({type, depth}) == 1)
          << int{type} << ' ' << int{depth};
    }
  }
  EXPECT_EQ(doubt(png({}, {1, 1, 4, 2})),
            "The bit depth of the PNG is 4; for color type 2 it must be 8 or 16.");
}

TEST(Png, MethodsAreThoseThatExist) {
  EXPECT_EQ(doubt(png({}, {1, 1, 8, 2, 1})), "") << "interlaced";
  EXPECT_EQ(doubt(png({}, {1, 1, 8, 2, 2})),
            "The interlace method of the PNG is 2, which is unknown.");
  EXPECT_EQ(doubt(png({}, {1, 1, 8, 2, 0, 1})),
            "The compression method of the PNG is 1, which is unknown.");
  EXPECT_EQ(doubt(png({}, {1, 1, 8, 2, 0, 0, 64})),
            "The filter method of the PNG is 64, which is unknown.");
}

TEST(Png, SidesHave31Bits) {
  EXPECT_EQ(doubt(png({}, {0x7FFFFFFF, 1})), "");
  EXPECT_NE(doubt(png({}, {0x80000000, 1})), "");
  EXPECT_NE(doubt(png({}, {1, 0x80000000})), "");
}

TEST(Png, PalettesHaveTheEntriesThatAreUsed) {
  const auto palette = [](const std::string& chunks) { return png(chunks, {4, 4, 8, 3}); };
  EXPECT_EQ(doubt(palette(png_chunk("PLTE", "abc"))), "");
  EXPECT_EQ(doubt(palette(png_chunk("PLTE", std::string(768, 'x')))), "");
  for (const std::size_t length : {0U, 4U, 771U}) {
    EXPECT_NE(doubt(palette(png_chunk("PLTE", std::string(length, 'x')))), "") << length;
  }
  EXPECT_EQ(doubt(palette({})), "The PNG uses a palette, but has none.");
  EXPECT_EQ(doubt(palette(png_chunk("PLTE", "abc") + png_chunk("PLTE", "abc"))),
            "The PNG has two palettes.");
  const std::string four = png_chunk("PLTE", "abcdefghijkl");
  EXPECT_EQ(remark(png(four, {4, 4, 1, 3})),
            "The palette of the PNG has 4 entries; with 1 bits it can have only 2.");
  EXPECT_EQ(remark(png(four, {4, 4, 2, 3})), "");
  EXPECT_EQ(remark(png(four, {4, 4, 8, 0})), "The PNG is grayscale, but has a palette.");
  EXPECT_EQ(remark(png(four, {4, 4, 8, 2})), "") << "a suggestion";
}

TEST(Png, TransparencyIsThatOfTheColourType) {
  const auto with = [](char type, std::size_t length) {
    const std::string palette = type == 3 ? png_chunk("PLTE", "abcdef") : std::string();
    return remark(png(palette + png_chunk("tRNS", std::string(length, '\1')), {4, 4, 8, type}));
  };
  EXPECT_EQ(with(0, 2), "");
  EXPECT_EQ(with(2, 6), "");
  EXPECT_EQ(with(3, 1), "");
  EXPECT_EQ(with(3, 2), "");
  EXPECT_EQ(with(0, 6), "!The tRNS chunk of the PNG has 6 bytes; it must have 2.");
  EXPECT_EQ(with(2, 2), "!The tRNS chunk of the PNG has 2 bytes; it must have 6.");
  EXPECT_NE(with(3, 0), "");
  EXPECT_NE(with(3, 3), "") << "there are two entries";
  EXPECT_EQ(with(4, 2), "!The PNG has both a tRNS chunk and an alpha channel.");
  EXPECT_EQ(with(6, 6), "!The PNG has both a tRNS chunk and an alpha channel.");
  const std::string before = png_chunk("tRNS", "a") + png_chunk("PLTE", "abc");
  EXPECT_EQ(remark(png(before, {4, 4, 8, 3})), "!The tRNS chunk of the PNG is before its palette.");
  const std::string twice = png_chunk("tRNS", "ab") + png_chunk("tRNS", "ab");
  EXPECT_EQ(remark(png(twice, {4, 4, 8, 0})), "!The PNG has two tRNS chunks.");
}

TEST(Png, CriticalChunksAreThoseOfTheFormat) {
  EXPECT_EQ(doubt(png(png_chunk("teSt", "x"))), "");
  EXPECT_EQ(doubt(png(png_chunk("TeSt", "x"))), "The PNG has the unknown critical chunk 'TeSt'.");
  EXPECT_NE(doubt(png(png_chunk("te t", "x"))), "");
  std::string bytes = png();
  bytes.insert(33, bytes.substr(8, 25));  // IHDR
  EXPECT_EQ(doubt(bytes), "The PNG has two IHDR chunks.");
}

TEST(Png, ChecksumsOfHeaderAndPaletteAreRight) {
  const auto damaged = [](std::string bytes, const std::string& chunk) {
    const std::size_t at = bytes.find(chunk) + 5;
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    return doubt(bytes);
  };
  const std::string palette = png(png_chunk("PLTE", "abc") + png_chunk("tRNS", "ab"), {4, 4, 8, 3});
  EXPECT_EQ(damaged(palette, "IHDR"), "The checksum of IHDR in the PNG is wrong.");
  EXPECT_EQ(damaged(palette, "PLTE"), "The checksum of PLTE in the PNG is wrong.");
  EXPECT_EQ(damaged(png(png_chunk("tEXt", "a text")), "tEXt"), "") << "it is not read";
}

TEST(Png, ImageDataBeginAsCompressedDataDo) {
  const auto with = [](const std::string& begin) {
    std::string bytes = png();
    return doubt(bytes.replace(bytes.find("IDAT") + 4, 2, begin));
  };
  for (const char* begin : {"\x78\x01", "\x78\x5e", "\x78\x9c", "\x78\xda", "\x08\x1d"}) {
    EXPECT_EQ(with(begin), "");
  }
  for (const char* begin : {"\x78\x9d", "\x79\x9c", "\x88\x1c", "\x78\xbb", "PK"}) {
    EXPECT_NE(with(begin), "") << begin;
  }
  std::string split = png();
  split.insert(split.find("IDAT") - 4, png_chunk("IDAT", ""));
  EXPECT_EQ(doubt(split), "") << "they may begin in the second chunk";
}

TEST(Png, CutsBehindTheHeaderAreFound) {
  const std::string whole = png();
  for (std::size_t size = whole.find("IDAT") + 4; size < whole.size(); ++size) {
    EXPECT_EQ(doubt(whole.substr(0, size)), size < whole.size() - 4 ? "The PNG is truncated." : "")
        << size;
  }
  EXPECT_EQ(doubt(whole + "bytes after the end"), "");
  std::string longer = whole;
  longer[whole.find("IDAT") - 2] = '\x7f';
  EXPECT_NE(doubt(longer), "") << "image data beyond the end";
}

TEST(Png, EveryCutBeforeTheImageDataIsAnUnexpectedEnd) {
  const std::string whole = png(png_chunk("gAMA", be32(45455)));
  const std::size_t enough = whole.find("IDAT") + 4;
  for (std::size_t size = kSniffBytes; size < enough; ++size) {
    EXPECT_EQ(error(whole.substr(0, size)), HeaderError::Kind::unexpected_end) << size;
  }
  EXPECT_EQ(header(whole.substr(0, enough)).width, 4U);
}

TEST(Png, AChunkOfFourGigabytesIsAnEndAndNoAllocation) {
  std::string bytes = png(png_chunk("tEXt", "x"));
  bytes.replace(bytes.find("tEXt") - 4, 4, "\xff\xff\xff\xff");
  EXPECT_EQ(error(bytes), HeaderError::Kind::unexpected_end);
}

}  // namespace
}  // namespace gltfx::image
