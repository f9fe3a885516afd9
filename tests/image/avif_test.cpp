// SPDX-License-Identifier: Apache-2.0
// Headers of AVIF images; tests/codec/avif/README.md has the sources of the files.
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "image/header.hpp"

namespace gltfx::image {
namespace {

using testing::HasSubstr;

std::string avif_file(const std::string& name) {
  std::ifstream file(GLTFX_SOURCE_DIR "/tests/codec/avif/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

HeaderResult read_avif_file(const std::string& bytes) {
  return read_header(std::as_bytes(std::span(bytes.data(), bytes.size())));
}

Header avif_header(const std::string& bytes) {
  const HeaderResult result = read_avif_file(bytes);
  if (const auto* header = std::get_if<Header>(&result)) return *header;
  ADD_FAILURE() << std::get<HeaderError>(result).problem;
  return {};
}

// The first of two texts of one length becomes the other one.
std::string replaced(std::string bytes, std::string_view from, std::string_view to) {
  const std::size_t at = bytes.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return bytes.replace(at, from.size(), to);
}

TEST(Avif, IsToldByAnyOfItsBrands) {
  const std::string bytes = avif_file("rgb.avif");
  const auto format = [](const std::string& file) {
    const Sniffed found = sniff(std::as_bytes(std::span(file.data(), file.size())));
    return found.known ? std::string(media_type(found.format)) : std::string();
  };
  EXPECT_EQ(format(bytes), "image/avif");
  EXPECT_EQ(format(replaced(bytes, "ftypavif", "ftypavis")), "image/avif");
  const std::string second = replaced(bytes, "ftypavif", "ftypmif1");
  EXPECT_EQ(format(second), "image/avif") << "it stands among the compatible ones";
  EXPECT_EQ(format(replaced(second, "avif", "heic")), "");
}

TEST(Avif, HeadersTellExtentChannelsAndDepth) {
  const Header rgba = avif_header(avif_file("rgba.avif"));
  EXPECT_EQ(rgba.width, 4U);
  EXPECT_EQ(rgba.height, 2U);
  EXPECT_EQ(rgba.bits, 8U);
  EXPECT_EQ(rgba.channels, Channels::rgba);
  EXPECT_EQ(rgba.transfer, Tag::srgb);
  EXPECT_EQ(rgba.doubt + rgba.remark, "");
  EXPECT_EQ(avif_header(avif_file("rgb.avif")).channels, Channels::rgb);
  EXPECT_EQ(avif_header(avif_file("grey.avif")).channels, Channels::luminance);
  EXPECT_EQ(avif_header(avif_file("deep.avif")).bits, 10U);
}

TEST(Avif, TurnedPicturesAreRemarked) {
  const Header header = avif_header(avif_file("turned.avif"));
  EXPECT_THAT(header.remark, HasSubstr("rotated"));
  EXPECT_TRUE(header.readers_differ);
}

TEST(Avif, WhatReadersRefuseIsDoubted) {
  const std::string bytes = avif_file("rgb.avif");
  EXPECT_THAT(avif_header(replaced(bytes, "av01", "hvc1")).doubt, HasSubstr("no AV1 image"));
  EXPECT_THAT(avif_header(replaced(bytes, "ispe", "free")).doubt, HasSubstr("no extent"));
  EXPECT_THAT(avif_header(bytes.substr(0, bytes.size() - 1)).doubt, HasSubstr("truncated"));
  EXPECT_THAT(avif_header(replaced(bytes, "mdat", "free")).doubt, HasSubstr("no image data"));
  const std::string depth = replaced(bytes, std::string("\x03\x08\x08\x08", 4), "\x03\x09\x08\x08");
  EXPECT_THAT(avif_header(depth).doubt, HasSubstr("9 bits"));
  const HeaderResult without = read_avif_file(replaced(bytes, "meta", "free"));
  ASSERT_TRUE(std::holds_alternative<HeaderError>(without));
  EXPECT_THAT(std::get<HeaderError>(without).problem, HasSubstr("no image items"));
}

TEST(Avif, CutAnywhereItIsNoSoundImage) {
  const std::string bytes = avif_file("rgba.avif");
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const HeaderResult result = read_avif_file(bytes.substr(0, size));
    const auto* header = std::get_if<Header>(&result);
    EXPECT_TRUE(header == nullptr || !header->doubt.empty()) << size;
  }
}

}  // namespace
}  // namespace gltfx::image
