// SPDX-License-Identifier: Apache-2.0
// Contents and errors of JPEG headers. The images are built here, segment by segment.
#include <string>

#include <gtest/gtest.h>

#include "image/header.hpp"
#include "image/headers.hpp"

namespace gltfx::image {
namespace {

using namespace std::literals;

using test::doubt;
using test::error;
using test::header;
using test::jpeg;
using test::jpeg_frame;
using test::jpeg_scan;
using test::jpeg_segment;
using test::jpeg_tables;
using test::remark;
using test::whole_jpeg;

TEST(Jpeg, SizeAndChannels) {
  const Header grey = header(jpeg(jpeg_frame(1)));
  EXPECT_EQ(grey.channels, Channels::luminance);
  EXPECT_EQ(grey.width, 32U);
  EXPECT_EQ(grey.height, 16U);
  EXPECT_EQ(grey.bits, 8U);
  EXPECT_EQ(grey.transfer, Tag::none);
  EXPECT_EQ(header(jpeg(jpeg_frame(3))).channels, Channels::rgb);
  EXPECT_EQ(error(jpeg(jpeg_frame(4))), HeaderError::Kind::invalid);
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
  EXPECT_EQ(error(jpeg(std::string("\xff\xe1\x00\x01", 4) + jpeg_frame(3))),
            HeaderError::Kind::invalid);
}

TEST(Jpeg, EveryCutBeforeTheFrameEndsIsAnUnexpectedEnd) {
  const std::string whole = jpeg(jpeg_frame(3));
  for (std::size_t size = kSniffBytes; size < whole.size(); ++size) {
    EXPECT_EQ(error(whole.substr(0, size)), HeaderError::Kind::unexpected_end) << size;
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

// Bytes of a whole JPEG changed at some place after a marker.
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
            "The JPEG has 12 bits per channel; loaders only support 8.");
  EXPECT_NE(doubt(patched_jpeg(kFrame, 3, "\0\0"s)), "") << "no lines";
  EXPECT_NE(doubt(patched_jpeg(kFrame, 5, "\0\0"s)), "") << "no columns";
  for (const char* factors : {"\x01", "\x10", "\x51", "\x15"}) {
    EXPECT_EQ(doubt(patched_jpeg(kFrame, 9, factors)),
              "The JPEG has a sampling factor that is not between 1 and 4.");
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
            "!The first scan of the JPEG uses a missing Huffman table.");
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

}  // namespace
}  // namespace gltfx::image
