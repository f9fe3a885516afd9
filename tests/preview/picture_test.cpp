// SPDX-License-Identifier: Apache-2.0
#include "preview/picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/tonemap.hpp"

namespace gltfx::preview {
namespace {

using testing::ElementsAre;
using testing::FloatEq;

// Two pixels: half covered by something grey, and nothing.
render::Framebuffer two_pixels() {
  render::Film film(2, 1);
  render::PathSample there;
  there.emitted = Rgb(0.5);
  there.alpha = 1;
  there.features.albedo = Rgb(0.25, 0.5, 1);
  there.features.normal = {0, 0, 2};
  there.features.depth = 4;
  there.features.material = 3;
  film.add(0, there);
  film.add(0, render::PathSample());
  film.add(1, render::PathSample());
  film.add(1, render::PathSample());
  render::Framebuffer buffer(2, 1, {true, true, true, true, true});
  render::resolve(film, {0, 1}, buffer);
  return buffer;
}

TEST(Framebuffer, HasTheLayersThatAreWanted) {
  render::Film film(1, 1);
  film.add(0, render::PathSample());
  render::Framebuffer buffer(1, 1, {.normal = true});
  render::resolve(film, {0, 1}, buffer);
  EXPECT_EQ(buffer.normal.size(), 1U);
  EXPECT_TRUE(buffer.albedo.empty() && buffer.depth.empty() && buffer.material.empty());
}

TEST(Develop, AlphaIsNotMultipliedIn) {
  const render::Framebuffer buffer = two_pixels();
  const Picture picture = tone_mapped_picture(buffer, true, PixelType::floats);
  EXPECT_EQ(picture.channels, 4U);
  EXPECT_THAT(picture.floats, ElementsAre(0.5F, 0.5F, 0.5F, 0.5F, 0, 0, 0, 0));
  EXPECT_TRUE(picture.bytes.empty());
}

TEST(Develop, BytesAreToneMapped) {
  const render::Framebuffer buffer = two_pixels();
  const Picture picture = tone_mapped_picture(buffer, false, PixelType::bytes);
  const auto expected =
      render::to_byte(render::srgb_encode(render::tone_map({0.25F, 0.25F, 0.25F})[0]));
  EXPECT_THAT(picture.bytes, ElementsAre(expected, expected, expected, 0, 0, 0));
}

TEST(Develop, Layers) {
  const render::Framebuffer buffer = two_pixels();
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
  const render::Framebuffer buffer = two_pixels();
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
  render::Framebuffer buffer(31, 31, {.alpha = true});
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
  render::Framebuffer nothing(31, 31, {.alpha = true});
  EXPECT_EQ(structural_similarity(checker(90, 0), checker(90, 20), nothing, nothing), 1);
  Picture b = checker(90, 0);
  for (std::size_t i = 0; i < std::size_t{3} * 31 * 10; ++i) b.bytes[i] = 200;
  render::Framebuffer below = nothing;
  for (std::size_t i = std::size_t{31} * 16; i < below.alpha.size(); ++i) below.alpha[i] = 1;
  EXPECT_NEAR(structural_similarity(checker(90, 0), b, below, nothing), 1, 1e-12);
  below.alpha[0] = 1;
  EXPECT_LT(structural_similarity(checker(90, 0), b, nothing, below), 0.9999);
}

}  // namespace
}  // namespace gltfx::preview
