// SPDX-License-Identifier: Apache-2.0
/// Images that glTF does not have, told by their first bytes.
#include "image/foreign.hpp"

#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/support/foreign_files.hpp"
#include "image/header.hpp"

namespace gltfx::image {
namespace {

using test::TiffAlpha;

std::optional<ForeignFormat> told(const std::string& bytes) {
  return sniff_foreign(std::as_bytes(std::span(bytes.data(), bytes.size())));
}

TEST(Foreign, FormatsAreToldByTheirFirstBytes) {
  EXPECT_EQ(told(test::bmp_file()), ForeignFormat::bmp);
  EXPECT_EQ(told(test::tga_file()), ForeignFormat::tga);
  EXPECT_EQ(told(test::tga_file(false)), ForeignFormat::tga);
  EXPECT_EQ(told(test::gif_file()), ForeignFormat::gif);
  EXPECT_EQ(told(test::tiff_file(TiffAlpha::none)), ForeignFormat::tiff);
  EXPECT_EQ(told(std::string("MM\0*\0\0\0\x08", 8)), ForeignFormat::tiff);
  EXPECT_EQ(told(test::psd_file()), ForeignFormat::psd);
  EXPECT_EQ(told(test::dds_file()), ForeignFormat::dds);
  EXPECT_EQ(told(test::ppm_file()), ForeignFormat::pnm);
  EXPECT_EQ(told(std::string("\0\0\0\x0cjP  \r\n\x87\n", 12)), ForeignFormat::jpeg2000);
  EXPECT_EQ(foreign_name(ForeignFormat::jpeg2000), "JPEG 2000");
  EXPECT_EQ(foreign_name(ForeignFormat::pnm), "PNM");
}

TEST(Foreign, WhatIsOfGltfOrNothingIsNotToldSo) {
  EXPECT_FALSE(told(""));
  EXPECT_FALSE(told(std::string("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR", 16)));
  EXPECT_FALSE(told("RIFF\x10\1\1\1WEBPVP8L........"));
  EXPECT_FALSE(told("BM is the beginning of many a text."));
  EXPECT_FALSE(told("P3D, and so is this, but it is no image"));
  EXPECT_FALSE(told("{\"asset\":{\"version\":\"2.0\"}}"));
  EXPECT_FALSE(told(std::string(200, '\0')));
  EXPECT_FALSE(told("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 3\n"));
}

TEST(Foreign, ATgaNeedsAHeaderThatFitsItsBytes) {
  const std::string tga = test::tga_file(false);
  EXPECT_FALSE(told(tga.substr(0, tga.size() - 1))) << "a texel is missing";
  const auto with = [&](std::size_t at, int value) {
    std::string changed = tga;
    changed[at] = static_cast<char>(value);
    return told(changed).has_value();
  };
  EXPECT_TRUE(with(2, 2));
  EXPECT_FALSE(with(1, 2)) << "kind of palette";
  EXPECT_FALSE(with(2, 4)) << "type";
  EXPECT_FALSE(with(2, 1)) << "a palette that is not there";
  EXPECT_FALSE(with(12, 0)) << "width";
  EXPECT_FALSE(with(16, 12)) << "bits";
  EXPECT_FALSE(with(17, 0xE8)) << "interleaved";
}

}  // namespace
}  // namespace gltfx::image
