// SPDX-License-Identifier: Apache-2.0
/// Contact sheets: the cells and the names below.
#include "preview/contact_sheet.hpp"

#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gltfx::preview {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

BakedPixels plain_pixels(std::uint32_t width, std::uint32_t height) {
  return {width, height, 3, std::vector<std::uint8_t>(std::size_t{width} * height * 3, 10)};
}

TEST(ContactSheet, CellsKeepTheShapeOfPictures) {
  ContactSheet sheet(3, {64, 64});
  sheet.add({}, "", "");
  sheet.add(plain_pixels(64, 32), "no room for words", "");
  const Picture picture = sheet.take();
  EXPECT_EQ(picture.width, 128U);
  EXPECT_EQ(picture.height, 128U);
  const auto red = [&](std::size_t x, std::size_t y) { return picture.bytes[(y * 128 + x) * 3]; };
  EXPECT_EQ(red(32, 32), 236);
  EXPECT_EQ(red(96, 32), 10);
  EXPECT_EQ(red(96, 5), 236) << "above a wide picture";
}

TEST(ContactSheet, LargePicturesBecomeSmallerAndHaveTheirShape) {
  ContactSheet sheet(1, {1024, 512});
  sheet.add(plain_pixels(1024, 512), "", "");
  const Picture picture = sheet.take();
  EXPECT_EQ(picture.width, 256U);
  EXPECT_EQ(picture.height, 128U + 26U);
  EXPECT_EQ(picture.bytes[(std::size_t{127} * 256 + 255) * 3], 10);
  EXPECT_EQ(picture.bytes[(std::size_t{128} * 256 + 255) * 3], 236);
}

// Columns of the line below a picture that have ink in them.
std::vector<std::size_t> inked(std::string_view name) {
  ContactSheet sheet(1, {100, 10});
  sheet.add({}, name, "nothing visible");
  const Picture picture = sheet.take();
  std::vector<std::size_t> columns;
  for (std::size_t x = 0; x < 100; ++x) {
    for (std::size_t y = 10; y < picture.height; ++y) {
      if (picture.bytes[(y * 100 + x) * 3] == 236) continue;
      columns.push_back(x);
      break;
    }
  }
  return columns;
}

std::size_t extent_of(const std::vector<std::size_t>& columns) {
  return columns.empty() ? 0 : columns.back() - columns.front() + 1;
}

TEST(ContactSheet, NamesStandBelow) {
  EXPECT_THAT(inked(""), IsEmpty());
  EXPECT_THAT(inked(" "), IsEmpty());
  const std::size_t narrow = extent_of(inked("l")), wide = extent_of(inked("W"));
  EXPECT_GE(narrow, 1U);
  EXPECT_LE(narrow, 3U);
  EXPECT_GT(wide, 12U);
  EXPECT_NEAR(static_cast<double>(inked("W").front() + inked("W").back()), 99, 2) << "centered";
  EXPECT_LT(extent_of(inked("AV")), 2 * extent_of(inked("A"))) << "kerning";
  EXPECT_GT(extent_of(inked("\xC3\xA4\xCE\xA9")), 15U) << "letters of other alphabets";
  EXPECT_EQ(inked("\xE6\x97\xA5"), inked("\xFF")) << "a box for what the font does not have";
}

TEST(ContactSheet, LongNamesEndWithDots) {
  const std::vector<std::size_t> columns = inked(std::string(500, 'm'));
  EXPECT_GE(columns.front(), 4U);
  EXPECT_LE(columns.back(), 95U);
  EXPECT_GT(extent_of(columns), 70U);
  EXPECT_EQ(columns, inked(std::string(501, 'm')));
}

TEST(ContactSheet, ACellWithoutAPictureSaysWhy) {
  const auto ink = [](const BakedPixels& pixels, std::string_view instead) {
    ContactSheet sheet(1, {200, 100});
    sheet.add(pixels, "", instead);
    const Picture picture = sheet.take();
    std::size_t dark = 0;
    for (std::size_t y = 30; y < 70; ++y) {
      for (std::size_t x = 0; x < 200; ++x) dark += picture.bytes[(y * 200 + x) * 3] < 100 ? 1 : 0;
    }
    return dark;
  };
  EXPECT_EQ(ink({}, ""), 0U);
  EXPECT_GT(ink({}, "nothing visible"), 200U);
  EXPECT_EQ(ink(plain_pixels(200, 100), "nothing visible"), 200U * 40U);
}

TEST(ContactSheet, LabelsThatRepeatHaveTheirFolder) {
  EXPECT_THAT(sheet_labels({"a/chair.glb", "./b/lamp.gltf"}), ElementsAre("chair", "lamp"));
  EXPECT_THAT(sheet_labels({"in/a/scene.glb", "in/b/scene.glb", "in/c.glb"}),
              ElementsAre("a/scene", "b/scene", "c"));
  EXPECT_THAT(sheet_labels({"a/x/scene.glb", "./b/x/scene.glb", "b/y/scene.glb"}),
              ElementsAre("a/x/scene", "b/x/scene", "y/scene"));
  EXPECT_THAT(sheet_labels({"scene.glb", "scene.gltf", "a/scene.glb"}),
              ElementsAre("scene.glb", "scene.gltf", "a/scene"));
  EXPECT_THAT(sheet_labels({"/scene.glb", "/a/scene.glb"}), ElementsAre("scene", "a/scene"));
  EXPECT_THAT(sheet_labels({}), IsEmpty());
}

}  // namespace
}  // namespace gltfx::preview
