// SPDX-License-Identifier: Apache-2.0
#include "bake/picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bake/tonemap.hpp"

namespace gltfx::bake {
namespace {

using testing::ElementsAre;
using testing::FloatEq;

// Two pixels: half covered by something grey, and nothing.
Framebuffer two_pixels() {
  Film film(2, 1);
  PathSample there;
  there.emitted = Rgb(0.5);
  there.alpha = 1;
  there.features.albedo = Rgb(0.25, 0.5, 1);
  there.features.normal = {0, 0, 2};
  there.features.depth = 4;
  there.features.material = 3;
  film.add(0, there);
  film.add(0, PathSample());
  film.add(1, PathSample());
  film.add(1, PathSample());
  Framebuffer buffer(2, 1, {true, true, true, true, true});
  resolve(film, {0, 1}, buffer);
  return buffer;
}

TEST(Film, KeepsMeansAndErrors) {
  Film film(1, 1);
  for (const double value : {1.0, 3.0}) {
    PathSample sample;
    sample.scattered = Rgb(value);
    film.add(0, sample);
  }
  EXPECT_EQ(film.radiance(0), Rgb(2));
  EXPECT_NEAR(film.error(0), 1, 1e-6);
}

TEST(Film, WhatIsNoNumberIsLeftOut) {
  Film film(1, 1);
  PathSample sample;
  sample.scattered = Rgb(std::nan(""));
  film.add(0, sample);
  EXPECT_EQ(film.radiance(0), Rgb());
}

TEST(Film, HoldsSomeRowsOnly) {
  Film film(1, 4, {0, 2});
  PathSample sample;
  sample.scattered = Rgb(1);
  sample.features.albedo = Rgb(0.5);
  film.add(1, sample);
  FeatureSums more;
  more.add(sample);
  more.add(sample);
  film.set_features(0, more, 0);
  film.set_features(1, more, 3);
  film.hold({1, 4});
  EXPECT_EQ(film.size(), 3U);
  EXPECT_EQ(film.first_pixel(), 1U);
  EXPECT_EQ(film.radiance(1), Rgb(1));
  EXPECT_EQ(film.features(1).count, 2U);
  EXPECT_EQ(film.at(1).material, 3U);
  film.add(3, sample);
  EXPECT_EQ(film.at(2).samples, 0U);
  EXPECT_EQ(film.features(3).count, 1U);
  film.hold({2, 4});
  EXPECT_EQ(film.radiance(3), Rgb(1));
  EXPECT_EQ(film.features(2).count, 0U);
}

TEST(Framebuffer, HasTheLayersThatAreWanted) {
  Film film(1, 1);
  film.add(0, PathSample());
  Framebuffer buffer(1, 1, {.normal = true});
  resolve(film, {0, 1}, buffer);
  EXPECT_EQ(buffer.normal.size(), 1U);
  EXPECT_TRUE(buffer.albedo.empty() && buffer.depth.empty() && buffer.material.empty());
}

TEST(Develop, AlphaIsNotMultipliedIn) {
  const Framebuffer buffer = two_pixels();
  const Picture picture = tone_mapped_picture(buffer, true, PixelType::floats);
  EXPECT_EQ(picture.channels, 4U);
  EXPECT_THAT(picture.floats, ElementsAre(0.5F, 0.5F, 0.5F, 0.5F, 0, 0, 0, 0));
  EXPECT_TRUE(picture.bytes.empty());
}

TEST(Develop, BytesAreToneMapped) {
  const Framebuffer buffer = two_pixels();
  const Picture picture = tone_mapped_picture(buffer, false, PixelType::bytes);
  const auto expected = to_byte(srgb_encode(tone_map({0.25F, 0.25F, 0.25F})[0]));
  EXPECT_THAT(picture.bytes, ElementsAre(expected, expected, expected, 0, 0, 0));
}

TEST(Develop, Layers) {
  const Framebuffer buffer = two_pixels();
  EXPECT_THAT(layer_picture(buffer, Layer::albedo, PixelType::floats).floats,
              ElementsAre(0.125F, 0.25F, 0.5F, 0, 0, 0));
  EXPECT_THAT(layer_picture(buffer, Layer::normal, PixelType::bytes).bytes,
              ElementsAre(128, 128, 255, 0, 0, 0));
  EXPECT_THAT(layer_picture(buffer, Layer::depth, PixelType::floats).floats,
              ElementsAre(FloatEq(4), FloatEq(4), FloatEq(4), 0, 0, 0));
  EXPECT_EQ(layer_picture(buffer, Layer::depth, PixelType::bytes).bytes[0], 255);
  EXPECT_EQ(layer_picture(buffer, Layer::material, PixelType::floats).floats[0], 3);
}

TEST(Develop, DifferencesCountWhereThereIsSomething) {
  const Framebuffer buffer = two_pixels();
  const Picture a{2, 1, 3, {10, 20, 30, 0, 0, 0}, {}};
  const Picture b{2, 1, 3, {13, 20, 30, 99, 99, 99}, {}};
  EXPECT_DOUBLE_EQ(mean_square_difference(a, b, buffer, buffer), 3);
  EXPECT_THAT(difference(a, b).bytes, ElementsAre(116, 128, 128, 0, 0, 0));
}

// Squares of one pixel, lighter and darker by `contrast`.
Picture checker(double middle, double contrast) {
  constexpr std::uint32_t kSide = 31;
  Picture picture{kSide, kSide, 3, {}, {}};
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    const double value = middle + (i % 2 == 0 ? contrast : -contrast);
    picture.bytes.insert(picture.bytes.end(), 3, static_cast<std::uint8_t>(value));
  }
  return picture;
}

// Of a window in the middle, where means, variances and covariance are known.
TEST(Similarity, IsTheFormulaOfThePaper) {
  Framebuffer buffer(31, 31, {.alpha = true});
  buffer.alpha[15 * 31 + 15] = 1;
  const auto similarity = [&](const Picture& a, const Picture& b) {
    return structural_similarity(a, b, buffer, buffer);
  };
  const double c1 = 2.55 * 2.55;
  const double c2 = 7.65 * 7.65;
  EXPECT_DOUBLE_EQ(similarity(checker(90, 20), checker(90, 20)), 1);
  EXPECT_NEAR(similarity(checker(60, 0), checker(120, 0)),
              (2 * 60 * 120 + c1) / (60 * 60 + 120 * 120 + c1), 1e-6);
  EXPECT_NEAR(similarity(checker(90, 0), checker(90, 20)), c2 / (400 + c2), 1e-3);
  EXPECT_NEAR(similarity(checker(90, 20), checker(90, -20)), (c2 - 800) / (c2 + 800), 1e-3);
}

TEST(Similarity, CountsWhereThereIsSomething) {
  Framebuffer nothing(31, 31, {.alpha = true});
  EXPECT_EQ(structural_similarity(checker(90, 0), checker(90, 20), nothing, nothing), 1);
  Picture b = checker(90, 0);
  for (std::size_t i = 0; i < std::size_t{3} * 31 * 10; ++i) b.bytes[i] = 200;
  Framebuffer below = nothing;
  for (std::size_t i = std::size_t{31} * 16; i < below.alpha.size(); ++i) below.alpha[i] = 1;
  EXPECT_NEAR(structural_similarity(checker(90, 0), b, below, nothing), 1, 1e-12);
  below.alpha[0] = 1;
  EXPECT_LT(structural_similarity(checker(90, 0), b, nothing, below), 0.9999);
}

}  // namespace
}  // namespace gltfx::bake
