// SPDX-License-Identifier: Apache-2.0
// What headers of images say, and what is wrong with them. The images are built here, byte by byte.
#include "image/header.hpp"

#include <set>
#include <string>
#include <utility>
#include <variant>

#include <gtest/gtest.h>

#include "image/png_builder.hpp"

namespace gltfx::image {
namespace {

using namespace std::literals;

using test::be32;
using test::jpeg;
using test::jpeg_frame;
using test::jpeg_scan;
using test::jpeg_segment;
using test::jpeg_tables;
using test::le;
using test::png;
using test::png_chunk;
using test::PngHeader;
using test::webp;
using test::webp_chunk;
using test::webp_file;
using test::webp_lossless;
using test::whole_jpeg;

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

// The sentence that is said of an image which can be read all the same.
std::string doubt(const std::string& bytes) { return header(bytes).doubt; }
// A remark, with '!' in front where readers differ.
std::string remark(const std::string& bytes) {
  const Header found = header(bytes);
  EXPECT_EQ(found.doubt, "");
  return (found.readers_differ ? "!" : "") + found.remark;
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
            "The bit depth of the PNG is 4, but colour type 2 has 8 or 16.");
}

TEST(Png, MethodsAreThoseThatExist) {
  EXPECT_EQ(doubt(png({}, {1, 1, 8, 2, 1})), "") << "interlaced";
  EXPECT_EQ(doubt(png({}, {1, 1, 8, 2, 2})),
            "The interlace method of the PNG is 2, which does not exist.");
  EXPECT_EQ(doubt(png({}, {1, 1, 8, 2, 0, 1})),
            "The compression method of the PNG is 1, which does not exist.");
  EXPECT_EQ(doubt(png({}, {1, 1, 8, 2, 0, 0, 64})),
            "The filter method of the PNG is 64, which does not exist.");
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
  EXPECT_EQ(doubt(palette({})), "The PNG has no palette, which it refers to.");
  EXPECT_EQ(doubt(palette(png_chunk("PLTE", "abc") + png_chunk("PLTE", "abc"))),
            "The PNG has two palettes.");
  const std::string four = png_chunk("PLTE", "abcdefghijkl");
  EXPECT_EQ(remark(png(four, {4, 4, 1, 3})),
            "The palette of the PNG has 4 entries, but 1 bits reach only 2.");
  EXPECT_EQ(remark(png(four, {4, 4, 2, 3})), "");
  EXPECT_EQ(remark(png(four, {4, 4, 8, 0})), "The PNG is grey, but has a palette.");
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
  EXPECT_EQ(with(0, 6), "!The tRNS chunk of the PNG has 6 bytes instead of 2.");
  EXPECT_EQ(with(2, 2), "!The tRNS chunk of the PNG has 2 bytes instead of 6.");
  EXPECT_NE(with(3, 0), "");
  EXPECT_NE(with(3, 3), "") << "there are two entries";
  EXPECT_EQ(with(4, 2), "!The PNG has a tRNS chunk beside its alpha channel.");
  EXPECT_EQ(with(6, 6), "!The PNG has a tRNS chunk beside its alpha channel.");
  const std::string before = png_chunk("tRNS", "a") + png_chunk("PLTE", "abc");
  EXPECT_EQ(remark(png(before, {4, 4, 8, 3})),
            "!The tRNS chunk of the PNG stands before its palette.");
  const std::string twice = png_chunk("tRNS", "ab") + png_chunk("tRNS", "ab");
  EXPECT_EQ(remark(png(twice, {4, 4, 8, 0})), "!The PNG has two tRNS chunks.");
}

TEST(Png, CriticalChunksAreThoseOfTheFormat) {
  EXPECT_EQ(doubt(png(png_chunk("teSt", "x"))), "");
  EXPECT_EQ(doubt(png(png_chunk("TeSt", "x"))),
            "The PNG has a critical chunk 'TeSt', which the format does not define.");
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
  EXPECT_EQ(damaged(png(png_chunk("tEXt", "a text")), "tEXt"), "") << "nobody reads it";
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
    EXPECT_EQ(doubt(whole.substr(0, size)),
              size < whole.size() - 4 ? "The PNG is cut off: its end is missing." : "")
        << size;
  }
  EXPECT_EQ(doubt(whole + "bytes that nobody reads"), "");
  std::string longer = whole;
  longer[whole.find("IDAT") - 2] = '\x7f';
  EXPECT_NE(doubt(longer), "") << "image data beyond the end";
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

TEST(Jpeg, ProcessesAreThoseThatReadersKnow) {
  const auto with = [](unsigned char marker) {
    const bool progressive = marker == 0xC2 || marker == 0xCA;
    return header(jpeg(jpeg_frame(3, marker) + jpeg_tables() +
                       jpeg_scan(3, progressive ? std::string(3, '\0') : std::string{0, 63, 0})));
  };
  for (const int marker : {0xC0, 0xC1, 0xC2}) {
    const Header found = with(static_cast<unsigned char>(marker));
    EXPECT_EQ(found.doubt + found.remark, "") << marker;
  }
  for (const int marker : {0xC9, 0xCA}) {
    const Header found = with(static_cast<unsigned char>(marker));
    EXPECT_EQ(found.doubt, "");
    EXPECT_NE(found.remark, "") << marker;
    EXPECT_TRUE(found.readers_differ);
  }
  for (const int marker : {0xC3, 0xC5, 0xC6, 0xC7, 0xCB, 0xCD, 0xCE, 0xCF, 0xDE}) {
    EXPECT_NE(with(static_cast<unsigned char>(marker)).doubt, "") << marker;
  }
}

// Bytes of a whole JPEG changed at some place behind a marker.
std::string patched_jpeg(unsigned char marker, std::size_t offset, const std::string& bytes) {
  std::string whole = whole_jpeg();
  const std::size_t at = whole.find(std::string{'\xff', static_cast<char>(marker)}, 2);
  return whole.replace(at + 2 + offset, bytes.size(), bytes);
}

TEST(Jpeg, FrameHeadersAreSound) {
  constexpr unsigned char kFrame = 0xC0;
  EXPECT_EQ(doubt(whole_jpeg()), "");
  EXPECT_EQ(doubt(whole_jpeg({}, 1)), "");
  EXPECT_EQ(doubt(patched_jpeg(kFrame, 2, "\x0c")),
            "The JPEG has 12 bits a channel; readers decode 8.");
  EXPECT_NE(doubt(patched_jpeg(kFrame, 3, "\0\0"s)), "") << "no lines";
  EXPECT_NE(doubt(patched_jpeg(kFrame, 5, "\0\0"s)), "") << "no columns";
  for (const char* factors : {"\x01", "\x10", "\x51", "\x15"}) {
    EXPECT_EQ(doubt(patched_jpeg(kFrame, 9, factors)),
              "A sampling factor of the JPEG is not from 1 to 4.");
  }
  EXPECT_EQ(doubt(patched_jpeg(kFrame, 9, "\x22")), "");
  EXPECT_NE(doubt(patched_jpeg(kFrame, 9, "\x44")), "") << "18 blocks";
  EXPECT_NE(doubt(patched_jpeg(kFrame, 10, "\x04")), "") << "table 4";
  EXPECT_NE(doubt(patched_jpeg(kFrame, 10, "\x03")), "") << "a table that there is not";
  std::string longer = jpeg_frame(3) + "x";
  longer[3] = '\x12';
  EXPECT_NE(doubt(jpeg(longer + jpeg_tables() + jpeg_scan(3))), "") << "length";
  EXPECT_EQ(doubt(jpeg(jpeg_frame(3) + jpeg_frame(3) + jpeg_tables() + jpeg_scan(3))),
            "The JPEG has two frame headers.");
}

TEST(Jpeg, TablesInFrontOfTheFirstScanAreSound) {
  EXPECT_NE(doubt(patched_jpeg(0xDB, 2, "\x04")), "") << "number";
  EXPECT_NE(doubt(patched_jpeg(0xDB, 2, "\x20")), "") << "precision";
  EXPECT_NE(doubt(patched_jpeg(0xDB, 2, "\x10")), "") << "too short for 16 bits";
  EXPECT_NE(doubt(patched_jpeg(0xC4, 2, "\x04")), "") << "number";
  EXPECT_NE(doubt(patched_jpeg(0xC4, 2, "\x20")), "") << "class";
  EXPECT_NE(doubt(patched_jpeg(0xC4, 3, "\x02\xff")), "") << "more codes than bytes";
  const auto huffman = [](std::string counts, std::size_t codes) {
    counts.resize(16);
    return doubt(jpeg(jpeg_frame(1) + jpeg_segment(0xC4, '\0' + counts + std::string(codes, '\1')) +
                      jpeg_tables() + jpeg_scan(1)));
  };
  EXPECT_EQ(huffman("\1\1\1", 3), "");
  EXPECT_NE(huffman("\2", 2), "") << "a code of ones";
  EXPECT_NE(huffman("\1\3", 4), "") << "more codes than there are";
  EXPECT_EQ(huffman("", 0), "");
  std::string counts(16, '\0');
  counts[15] = '\1';
  const auto symbol = [&](char table, char value) {
    return doubt(jpeg(jpeg_frame(1) + jpeg_segment(0xC4, table + counts + value) + jpeg_tables() +
                      jpeg_scan(1)));
  };
  EXPECT_EQ(symbol('\0', '\x0f'), "");
  EXPECT_NE(symbol('\0', '\x10'), "") << "more bits than there are";
  EXPECT_EQ(symbol('\x10', '\xff'), "") << "AC";
}

TEST(Jpeg, FirstScansAreSound) {
  constexpr unsigned char kScan = 0xDA;
  EXPECT_NE(doubt(patched_jpeg(kScan, 2, "\x04")), "") << "components";
  EXPECT_NE(doubt(patched_jpeg(kScan, 2, "\0"s)), "") << "components";
  EXPECT_NE(doubt(patched_jpeg(kScan, 3, "\x09")), "") << "a component that there is not";
  EXPECT_NE(doubt(patched_jpeg(kScan, 4, "\x40")), "") << "table";
  EXPECT_EQ(remark(patched_jpeg(kScan, 4, "\x10")),
            "!The JPEG lacks a Huffman table that its first scan uses.");
  EXPECT_NE(remark(patched_jpeg(kScan, 9, "\1")), "");
  EXPECT_NE(remark(patched_jpeg(kScan, 10, "\x3e")), "");
  const auto progressive = [](char components, const std::string& band) {
    return doubt(jpeg(jpeg_frame(3, 0xC2) + jpeg_tables() + jpeg_scan(components, band)));
  };
  EXPECT_EQ(progressive(3, "\0\0\1"s), "");
  EXPECT_EQ(progressive(1, "\1\5\2"s), "");
  EXPECT_NE(progressive(3, "\0\5\0"s), "") << "DC and AC";
  EXPECT_NE(progressive(3, "\1\5\0"s), "") << "AC of several components";
  EXPECT_NE(progressive(1, "\5\1\0"s), "");
  EXPECT_NE(progressive(1, "\1\x40\0"s), "");
  EXPECT_NE(progressive(3, "\0\0\x0e"s), "");
  EXPECT_NE(progressive(3, "\0\0\x31"s), "") << "two bits at once";
  EXPECT_EQ(doubt(jpeg(jpeg_frame(3) + jpeg_tables())), "The JPEG ends before its first scan.");
}

TEST(Jpeg, BytesBetweenSegmentsAreNotJudged) {
  const std::string bytes = jpeg(jpeg_frame(3) + "\1junk" + jpeg_tables() + jpeg_scan(3));
  EXPECT_EQ(doubt(bytes), "");
  EXPECT_EQ(header(bytes).width, 32U);
}

TEST(Webp, LossyLosslessAndExtended) {
  const Header lossy = header(webp("VP8 ", "\x10\0\0\x9d\x01\x2a\x40\x41\x20\x80"s));
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
  const std::string lossy = webp("VP8 ", "\x10\0\0\x9d\x01\x2a\x40\x41\x20\x80"s);
  const std::string lossless = webp("VP8L", "\x2f\xff\xc0\x1f\x10"s);
  EXPECT_EQ(fault(lossy.substr(0, 29)), HeaderFault::Kind::unexpected_end);
  EXPECT_EQ(header(lossy).bits, 8U);
  EXPECT_EQ(fault(lossless.substr(0, 24)), HeaderFault::Kind::unexpected_end);
  EXPECT_EQ(header(lossless).bits, 8U);
  EXPECT_EQ(fault(webp("VPxx", std::string(20, '\0'))), HeaderFault::Kind::invalid);
}

TEST(Webp, SizesReachAsFarAsTheBytes) {
  const std::string whole = webp("VP8L", webp_lossless(4, 4) + std::string(9, 'x'));
  EXPECT_EQ(remark(whole), "");
  EXPECT_EQ(remark(whole + "behind"), "");
  for (std::size_t size = 25; size < whole.size(); ++size) {
    EXPECT_EQ(doubt(whole.substr(0, size)), "The WebP is cut off: " + std::to_string(size) +
                                                " of " + std::to_string(whole.size()) +
                                                " bytes are there.");
  }
  const auto with = [&](std::size_t offset, std::uint32_t size) {
    std::string bytes = whole + "xx";
    return bytes.replace(offset, 4, le(size, 4));
  };
  EXPECT_NE(doubt(with(4, 20)), "") << "shorter than its chunk";
  EXPECT_NE(doubt(with(16, 1000)), "") << "a chunk beyond the file";
  EXPECT_NE(remark(with(4, static_cast<std::uint32_t>(whole.size()) - 7)), "") << "odd";
}

TEST(Webp, BitstreamsHaveTheirVersions) {
  const auto lossy = [](const std::string& tag) {
    return doubt(webp("VP8 ", tag + "\x9d\x01\x2a\x40\x41\x20\x80"s));
  };
  EXPECT_EQ(lossy("\x10\0\0"s), "");
  EXPECT_EQ(lossy("\x16\0\0"s), "");
  EXPECT_NE(lossy("\x18\0\0"s), "") << "version 4";
  EXPECT_NE(lossy("\x11\0\0"s), "") << "no key frame";
  EXPECT_NE(lossy("\0\0\0"s), "") << "not shown";
  EXPECT_NE(lossy("\x10\x10\0"s), "") << "a partition of 128 bytes";
  std::string lossless = webp_lossless(4, 4);
  lossless[4] = '\x20';
  EXPECT_NE(doubt(webp("VP8L", lossless)), "");
}

TEST(Webp, ExtendedFilesAgreeWithTheirImage) {
  const auto file = [](const std::string& extended, const std::string& more) {
    return webp_file(webp_chunk("VP8X", extended) + more);
  };
  const auto flags = [](std::uint32_t value) { return le(value, 4) + le(3, 3) + le(3, 3); };
  const std::string image = webp_chunk("VP8L", webp_lossless(4, 4));
  const std::string profile = webp_chunk("ICCP", "profile");
  EXPECT_EQ(remark(file(flags(0), profile + image)), "");
  EXPECT_EQ(remark(file(flags(0x10), image)), "") << "alpha need not be there";
  EXPECT_EQ(remark(file(flags(0), webp_chunk("VP8L", webp_lossless(4, 4, true)))),
            "!The image in the WebP has alpha, which the flags of the file deny.");
  const std::string lossy = webp_chunk("VP8 ", "\x10\0\0\x9d\x01\x2a\4\0\4\0"s);
  EXPECT_EQ(remark(file(flags(0), lossy)), "");
  EXPECT_NE(remark(file(flags(0), webp_chunk("ALPH", "x") + lossy)), "");
  for (const std::uint32_t reserved : {1U, 0x40U, 0x80U, 0x100U, 0x80000000U}) {
    EXPECT_EQ(remark(file(flags(reserved), image)), "Reserved bits of the WebP are set.");
  }
  EXPECT_EQ(doubt(file(flags(0), webp_chunk("VP8L", webp_lossless(4, 5)))),
            "The canvas of the WebP has 4 by 4 pixels, its image 4 by 5.");
  EXPECT_EQ(doubt(file(flags(0), profile)), "The WebP has no image data.");
  std::string longer = file(flags(0), image);
  longer[longer.find("VP8L") + 5] = '\1';
  EXPECT_EQ(doubt(longer), "The image in the WebP is larger than the file.");
  std::string behind = file(flags(0), profile) + image;
  EXPECT_EQ(doubt(behind), "The WebP has no image data.") << "behind its end";
  EXPECT_NE(doubt(file(flags(0) + "xx", image)), "") << "length of VP8X";
  EXPECT_NE(doubt(file(le(0, 4) + std::string(6, '\xff'), image)), "") << "canvas";
  EXPECT_NE(doubt(file(flags(0), webp_chunk("VP8L", "x" + std::string(9, '\0')))), "");
}

TEST(Webp, ManyChunksAreNotWalkedThrough) {
  std::string chunks = webp_chunk("VP8X", le(0, 4) + le(3, 3) + le(3, 3));
  for (int i = 0; i < 70000; ++i) chunks += webp_chunk("none", {});
  EXPECT_EQ(remark(webp_file(chunks)), "");
}

TEST(Webp, AnimationsNeedFrames) {
  const std::string extended = webp_chunk("VP8X", le(2, 4) + le(3, 3) + le(3, 3));
  const Header sound = header(webp_file(extended + webp_chunk("ANIM", std::string(6, 'x')) +
                                        webp_chunk("ANMF", std::string(16, 'x'))));
  EXPECT_TRUE(sound.animated);
  EXPECT_EQ(sound.doubt, "");
  EXPECT_EQ(doubt(webp_file(extended)), "The WebP is said to be animated, but has no frame.");
  const std::string still = webp_chunk("VP8X", le(0, 4) + le(3, 3) + le(3, 3));
  EXPECT_NE(doubt(webp_file(still + webp_chunk("ANMF", std::string(16, 'x')))), "")
      << "frames that the flags deny";
}

TEST(Webp, WithoutPixelsIsDoubted) {
  EXPECT_FALSE(header(webp("VP8 ", "\x10\0\0\x9d\x01\x2a\0\x40\x20\x80"s)).doubt.empty());
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
