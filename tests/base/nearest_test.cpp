// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <string>

#include <gtest/gtest.h>

#include "base/text.hpp"

namespace gltfx {
namespace {

constexpr std::array<std::string_view, 6> kNames{
    "baseColorFactor", "baseColorTexture", "metallicFactor", "roughnessFactor", "name", "mode"};

std::string_view nearest_name(std::string_view word) { return nearest(word, kNames); }

TEST(Nearest, FindsWhatWasMeant) {
  EXPECT_EQ(nearest_name("baseColourFactor"), "baseColorFactor");
  EXPECT_EQ(nearest_name("baseColorTextrue"), "baseColorTexture");
  EXPECT_EQ(nearest_name("metalicFactor"), "metallicFactor");
  EXPECT_EQ(nearest_name("base_color_factor"), "baseColorFactor");
  EXPECT_EQ(nearest_name("BASECOLORFACTOR"), "baseColorFactor");
  EXPECT_EQ(nearest_name("nmae"), "name");
  EXPECT_EQ(nearest_name("mode"), "mode");
}

TEST(Nearest, FindsNothingWhereNothingIsNear) {
  EXPECT_EQ(nearest_name(""), "");
  EXPECT_EQ(nearest_name("x"), "");
  EXPECT_EQ(nearest_name("emissiveStrength"), "");
  EXPECT_EQ(nearest_name("moon"), "");
  EXPECT_EQ(nearest_name("factor"), "");
  EXPECT_EQ(nearest("abc", {}), "");
}

TEST(Nearest, CaseCountsHalfAndATranspositionOnce) {
  constexpr std::array<std::string_view, 3> kWords{"abcxyf", "abCdef", "abcdfe"};
  EXPECT_EQ(nearest("abcdef", kWords), "abCdef");
  constexpr std::array<std::string_view, 2> kSwapped{"axxdef", "abcdfe"};
  EXPECT_EQ(nearest("abcdef", kSwapped), "abcdfe");
}

TEST(Nearest, InAShortWordOnlyTheCaseMayDiffer) {
  constexpr std::array<std::string_view, 2> kShort{"xy", "u"};
  EXPECT_EQ(nearest("XY", kShort), "xy");
  EXPECT_EQ(nearest("U", kShort), "u");
  EXPECT_EQ(nearest("xz", kShort), "");
}

TEST(Nearest, TheFirstOfEquallyNearOnesIsTaken) {
  constexpr std::array<std::string_view, 2> kTwins{"abcd1", "abcd2"};
  EXPECT_EQ(nearest("abcd3", kTwins), "abcd1");
}

TEST(Nearest, VeryLongWordsAreNotCompared) {
  const std::string name(129, 'a');
  const std::array<std::string_view, 1> names{name};
  EXPECT_EQ(nearest(name, names), "");
  EXPECT_EQ(nearest(std::string_view(name).substr(1), names), name);
}

TEST(Nearest, IsAtMostTwoEditsAway) {
  EXPECT_EQ(nearest_name("roughnessFctr"), "roughnessFactor");
  EXPECT_EQ(nearest_name("roughnesFctr"), "");
  constexpr std::string_view kModes[]{"OPAQUE", "MASK", "LINEAR", "CUBICSPLINE"};
  EXPECT_EQ(nearest("CUBIC", kModes), "");
  EXPECT_EQ(nearest("MASKED", kModes), "MASK");
  EXPECT_EQ(nearest("OPAK", kModes), "");
}

TEST(Nearest, IsAlsoWhatDiffersOnlyInCaseAndUnderscores) {
  constexpr std::string_view kSpelled[]{"KHR_materials_unlit", "doubleSided"};
  EXPECT_EQ(nearest("khrMaterialsUnlit", kSpelled), "KHR_materials_unlit");
  EXPECT_EQ(nearest("DOUBLE_SIDED", kSpelled), "doubleSided");
  constexpr std::string_view kTwins[]{"base_color", "BASEcOLOR"};
  EXPECT_EQ(nearest("bASE_Color_", kTwins), "");
}

}  // namespace
}  // namespace gltfx
