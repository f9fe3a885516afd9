// SPDX-License-Identifier: Apache-2.0
// What fixtures/figures are about can be seen in their pictures: things in columns, from the left,
// that differ in one property.
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sanitized.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;

const fs::path kFixtures = fs::path(GLTFX_SOURCE_DIR) / "fixtures";

BakeOptions small() {
  BakeOptions options;
  options.sizes = {{72, 48}};
  options.samples = kSanitized ? 6 : 16;
  options.denoise = false;
  options.lights = BakeLights::asset;
  options.cameras = {"0"};
  return options;
}

// Part of a picture, from 0 to 1, from the upper left.
struct Area {
  double left, right, top, bottom;
};

struct Statistics {
  std::array<double, 3> mean{};  // red, green and blue of a display, 0 to 255
  double brightness = 0;
  double contrast = 0;  // standard deviation of the brightness
  double warmth() const { return mean[0] - mean[2]; }
};

class Picture {
 public:
  explicit Picture(const fs::path& file, const BakeOptions& options = small()) {
    BakeReport report = bake_file(file.native(), options);
    EXPECT_EQ(report.problem, BakeProblem::none) << file << ": " << report.error;
    EXPECT_THAT(report.notes, IsEmpty()) << file;
    pixels_ = std::move(report.pixels);
  }

  Statistics at(const Area& area) const {
    Statistics result;
    double count = 0, squares = 0;
    const auto place = [](double part, std::uint32_t size) {
      return static_cast<std::uint32_t>(std::lround(part * size));
    };
    for (std::uint32_t y = place(area.top, pixels_.height); y < place(area.bottom, pixels_.height);
         ++y) {
      for (std::uint32_t x = place(area.left, pixels_.width); x < place(area.right, pixels_.width);
           ++x) {
        double brightness = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          const double value = pixels_.bytes[(std::size_t{y} * pixels_.width + x) * 3 + c];
          result.mean[c] += value;
          brightness += value / 3;
        }
        result.brightness += brightness;
        squares += brightness * brightness;
        ++count;
      }
    }
    for (double& channel : result.mean) channel /= count;
    result.brightness /= count;
    result.contrast =
        std::sqrt(std::max(0.0, squares / count - result.brightness * result.brightness));
    return result;
  }

  // Of the middle of each column.
  std::vector<Statistics> columns(std::size_t count, double top, double bottom,
                                  double width = 0.3) const {
    std::vector<Statistics> result;
    for (std::size_t i = 0; i < count; ++i) {
      const double middle = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
      const double half = width / 2 / static_cast<double>(count);
      result.push_back(at({middle - half, middle + half, top, bottom}));
    }
    return result;
  }

  const std::vector<std::uint8_t>& bytes() const { return pixels_.bytes; }

 private:
  BakedPixels pixels_;
};

Picture figure(const std::string& name, bool denoise = false) {
  BakeOptions options = small();
  options.denoise = denoise;
  return Picture(kFixtures / "figures" / (name + ".gltf"), options);
}

// By at least `step` from column to column.
template <class Property>
void expect_rising(const std::vector<Statistics>& columns, const Property& of, double step) {
  for (std::size_t i = 1; i < columns.size(); ++i) {
    EXPECT_GT(of(columns[i]), of(columns[i - 1]) + step) << "column " << i;
  }
}

double brightness(const Statistics& s) { return s.brightness; }
double warmth(const Statistics& s) { return s.warmth(); }
double red(const Statistics& s) { return s.mean[0]; }
double yellow(const Statistics& s) { return -s.mean[2]; }

TEST(Figures, NoneIsBlank) {
  std::size_t count = 0;
  BakeOptions options = small();
  options.sizes = {{36, 24}};
  options.samples = 4;
  for (const auto& entry : fs::directory_iterator(kFixtures / "figures")) {
    if (entry.path().extension() != ".gltf") continue;
    ++count;
    EXPECT_GT(Picture(entry.path(), options).at({0, 1, 0, 1}).contrast, 8) << entry.path();
  }
  EXPECT_GE(count, 25U);
}

TEST(Figures, ABacklitSheetBecomesBrighterWithTheFactor) {
  const Picture picture = figure("backlit-factor");
  expect_rising(picture.columns(5, 0.65, 0.9), brightness, 8);
  const std::vector<Statistics> ball = picture.columns(5, 0.41, 0.51, 0.15);
  EXPECT_LT(ball[4].brightness, 40) << "the shadow on the other side";
}

TEST(Figures, TransmittedLightHasAColorOfItsOwn) {
  const std::vector<Statistics> columns = figure("backlit-color").columns(5, 0.65, 0.9);
  expect_rising(columns, red, 8);
  expect_rising(columns, yellow, 5);
}

TEST(Figures, AMapMakesStripes) {
  const Picture picture = figure("striped-factor");
  EXPECT_GT(picture.at({0.3, 0.6, 0.2, 0.8}).contrast, 40);
}

TEST(Figures, TheOtherSideOfANoteShinesThrough) {
  const Picture picture = figure("two-sided-note");
  const auto balance = [&](const Area& area) {
    const Statistics s = picture.at(area);
    return s.mean[0] - s.mean[1];
  };
  const double front = balance({0.16, 0.48, 0.05, 0.28});
  const double half = balance({0.16, 0.48, 0.38, 0.61});
  const double back = balance({0.34, 0.66, 0.72, 0.94});
  EXPECT_LT(front, -5) << "green";
  EXPECT_GT(half, front + 10);
  EXPECT_GT(back, half + 10) << "red";
}

TEST(Figures, ALampBehindASheetIsSeenAsTheSheetScatters) {
  const Picture picture = figure("emissive-behind");
  const std::vector<Statistics> lamp = picture.columns(3, 0.4, 0.5, 0.2);
  const std::vector<Statistics> edge = picture.columns(3, 0.68, 0.76, 0.2);
  const auto fall = [&](std::size_t i) { return lamp[i].brightness - edge[i].brightness; };
  EXPECT_LT(std::fabs(fall(0)), 6) << "opaque";
  EXPECT_GT(fall(2), 15) << "diffuse transmission";
  EXPECT_GT(fall(1), fall(2) + 20) << "rough transmission";
}

TEST(Figures, RoughnessBlursWhatIsSeenThroughGlassOnly) {
  const std::vector<Statistics> glass = figure("rough-glass", true).columns(3, 0.27, 0.65, 0.6);
  EXPECT_GT(glass[0].contrast, glass[2].contrast + 4);
  EXPECT_GT(glass[1].contrast, glass[2].contrast + 4);
  for (const Statistics& each : figure("rough-wax").columns(3, 0.45, 0.6, 0.4)) {
    EXPECT_LT(each.contrast, 30) << "nothing";
  }
}

TEST(Figures, TransmissionHidesDiffuseTransmission) {
  const Picture picture = figure("clear-or-diffuse");
  expect_rising(picture.columns(5, 0.6, 0.75, 0.5), warmth, 0);
}

TEST(Figures, AttenuationIsSeenWhereLightEnters) {
  const std::vector<Statistics> columns = figure("attenuation").columns(3, 0.75, 0.9);
  EXPECT_NEAR(columns[0].warmth(), 0, 12);
  expect_rising(columns, warmth, 8);
  expect_rising(figure("candle").columns(3, 0.3, 0.5), warmth, 3);
}

TEST(Figures, WhatIsBehindShinesThroughLeavesAndChina) {
  const std::vector<Statistics> leaves = figure("firefly").columns(2, 0.3, 0.7);
  EXPECT_GT(leaves[1].brightness, leaves[0].brightness + 25);
  const std::vector<Statistics> cups = figure("teacup").columns(3, 0.45, 0.6);
  EXPECT_GT(cups[1].brightness, cups[0].brightness + 15);
  EXPECT_GT(cups[2].warmth(), cups[1].warmth() + 3);
  const std::vector<Statistics> plants = figure("red-plant").columns(3, 0.4, 0.65, 0.6);
  expect_rising(
      plants, [](const Statistics& s) { return s.mean[0] - s.mean[1]; }, 12);
}

TEST(Figures, ThickOnesRefractAndDiffuseOnesHideWhatIsBehind) {
  const std::vector<Statistics> columns = figure("thin-and-thick").columns(4, 0.38, 0.55, 0.5);
  EXPECT_GT(columns[0].contrast, columns[1].contrast + 10);
  EXPECT_GT(columns[2].contrast, columns[3].contrast + 10);
}

TEST(Figures, ManyCollisionsLookLikeTheirColor) {
  const std::vector<Statistics> columns = figure("sss-or-diffuse").columns(2, 0.75, 0.9);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(columns[1].mean[c], columns[0].mean[c], 24) << "channel " << c;
  }
  for (const Statistics& each : figure("sss-ways-in").columns(3, 0.75, 0.9)) {
    EXPECT_GT(each.warmth(), 25) << "skin";
  }
}

TEST(Figures, ForwardScatteringLetsLightThrough) {
  const Picture picture = figure("anisotropy");
  const std::vector<Statistics> above = picture.columns(3, 0.32, 0.4);
  const std::vector<Statistics> below = picture.columns(3, 0.58, 0.66);
  EXPECT_GT(above[0].brightness, above[2].brightness + 10);
  expect_rising(below, brightness, 2);
}

TEST(Figures, CoverageIsNoTransmission) {
  const std::vector<Statistics> columns = figure("alpha-or-clear").columns(2, 0.3, 0.6);
  EXPECT_GT(columns[1].contrast, columns[0].contrast + 8);
  EXPECT_GT(columns[0].brightness, columns[1].brightness);
}

TEST(Figures, GlassIsTintedMappedAndCutOut) {
  const std::vector<Statistics> tints = figure("tint").columns(3, 0.35, 0.6);
  expect_rising(
      tints, [](const Statistics& s) { return s.mean[0] - s.mean[1]; }, 5);
  EXPECT_GT(tints[1].warmth(), tints[0].warmth() + 30) << "yellow";
  const std::vector<Statistics> spots = figure("clear-map").columns(3, 0.35, 0.6, 0.5);
  EXPECT_GT(spots[1].contrast, spots[0].contrast + 8);
  EXPECT_GT(spots[0].brightness, spots[2].brightness + 10);
  const std::vector<Statistics> masks = figure("masked-glass").columns(2, 0.3, 0.6, 0.6);
  EXPECT_GT(masks[0].brightness, masks[1].brightness + 10);
  EXPECT_GT(masks[1].contrast, 20);
}

TEST(Figures, LayersMultiply) {
  const Picture picture = figure("layers");
  const double one = picture.at({0.29, 0.36, 0.2, 0.65}).brightness;
  const double three = picture.at({0.5, 0.62, 0.25, 0.6}).brightness;
  EXPECT_GT(one, three + 20);
}

TEST(Figures, MetalLetsNoLightThrough) {
  const std::vector<Statistics> columns = figure("metallic-sweep").columns(5, 0.72, 0.82, 0.5);
  EXPECT_GT(columns[4].brightness, columns[0].brightness + 10);
}

TEST(Figures, BaseColorTintsAlikeAndAbsorptionByThickness) {
  const Picture picture = figure("absorption");
  const auto green = [&](std::size_t column, double top, double bottom) {
    const Statistics s = picture.columns(2, top, bottom, 0.1)[column];
    return (s.mean[1] - s.mean[0]) / s.mean[1];
  };
  EXPECT_GT(green(1, 0.1, 0.25) - green(1, 0.45, 0.6), 0.1) << "head and neck";
  EXPECT_GT(green(0, 0.45, 0.6), green(1, 0.45, 0.6) + 0.1) << "necks";
}

TEST(Figures, AnUpgradeDrawsTheSameBytes) {
  std::size_t pairs = 0;
  for (const auto& entry : fs::directory_iterator(kFixtures / "legacy" / "upgraded")) {
    if (entry.path().extension() != ".gltf" && entry.path().extension() != ".glb") continue;
    if (entry.path().stem() == "chalice") continue;  // of specular-glossiness, which is computed
    const fs::path before = kFixtures / "legacy" / entry.path().filename();
    BakeOptions options = small();
    options.cameras.clear();
    options.sizes = {{32, 24}};
    options.samples = 4;
    const BakeReport old = bake_file(before.native(), options);
    ASSERT_EQ(old.problem, BakeProblem::none) << before << ": " << old.error;
    EXPECT_EQ(old.pixels.bytes, bake_file(entry.path().native(), options).pixels.bytes) << before;
    ++pairs;
  }
  EXPECT_GE(pairs, 5U);
}

}  // namespace
}  // namespace gltfx
