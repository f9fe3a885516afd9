// SPDX-License-Identifier: Apache-2.0
// Contents and errors of WebP headers. The images are built here, chunk by chunk.
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
using test::le;
using test::remark;
using test::webp;
using test::webp_chunk;
using test::webp_file;
using test::webp_lossless;

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
  EXPECT_EQ(error(lossy.substr(0, 29)), HeaderError::Kind::unexpected_end);
  EXPECT_EQ(header(lossy).bits, 8U);
  EXPECT_EQ(error(lossless.substr(0, 24)), HeaderError::Kind::unexpected_end);
  EXPECT_EQ(header(lossless).bits, 8U);
  EXPECT_EQ(error(webp("VPxx", std::string(20, '\0'))), HeaderError::Kind::invalid);
}

TEST(Webp, SizesReachAsFarAsTheBytes) {
  const std::string whole = webp("VP8L", webp_lossless(4, 4) + std::string(9, 'x'));
  EXPECT_EQ(remark(whole), "");
  EXPECT_EQ(remark(whole + "behind"), "");
  for (std::size_t size = 25; size < whole.size(); ++size) {
    EXPECT_EQ(doubt(whole.substr(0, size)), "The WebP is truncated: it has " +
                                                std::to_string(size) + " of " +
                                                std::to_string(whole.size()) + " bytes.");
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
            "!The image in the WebP has alpha, but the alpha flag is not set.");
  const std::string lossy = webp_chunk("VP8 ", "\x10\0\0\x9d\x01\x2a\4\0\4\0"s);
  EXPECT_EQ(remark(file(flags(0), lossy)), "");
  EXPECT_NE(remark(file(flags(0), webp_chunk("ALPH", "x") + lossy)), "");
  for (const std::uint32_t reserved : {1U, 0x40U, 0x80U, 0x100U, 0x80000000U}) {
    EXPECT_EQ(remark(file(flags(reserved), image)),
              "The WebP has reserved bits that are not zero.");
  }
  EXPECT_EQ(doubt(file(flags(0), webp_chunk("VP8L", webp_lossless(4, 5)))),
            "The canvas of the WebP is 4x4, but its image is 4x5.");
  EXPECT_EQ(doubt(file(flags(0), profile)), "The WebP has no image data.");
  std::string longer = file(flags(0), image);
  longer[longer.find("VP8L") + 5] = '\1';
  EXPECT_EQ(doubt(longer), "The image in the WebP is larger than the file.");
  std::string behind = file(flags(0), profile) + image;
  EXPECT_EQ(doubt(behind), "The WebP has no image data.") << "after its end";
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
  EXPECT_EQ(doubt(webp_file(extended)), "The WebP is marked as animated, but has no frames.");
  const std::string still = webp_chunk("VP8X", le(0, 4) + le(3, 3) + le(3, 3));
  EXPECT_NE(doubt(webp_file(still + webp_chunk("ANMF", std::string(16, 'x')))), "")
      << "frames that the flags deny";
}

TEST(Webp, WithoutPixelsIsDoubted) {
  EXPECT_FALSE(header(webp("VP8 ", "\x10\0\0\x9d\x01\x2a\0\x40\x20\x80"s)).doubt.empty());
}

TEST(Webp, WrongSignaturesAreDoubted) {
  EXPECT_FALSE(header(webp("VP8L", std::string(20, '\0'))).doubt.empty());
  EXPECT_FALSE(header(webp("VP8 ", std::string(20, '\0'))).doubt.empty());
}

}  // namespace
}  // namespace gltfx::image
