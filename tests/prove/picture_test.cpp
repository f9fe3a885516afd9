// SPDX-License-Identifier: Apache-2.0
#include "prove/picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/sampler.hpp"

namespace gltfx::prove {
namespace {

using preview::Picture;
using testing::ElementsAre;

TEST(PictureDifference, CountsWhereThereIsSomething) {
  render::Framebuffer buffer(2, 1, {.alpha = true});
  buffer.alpha[0] = 0.5F;
  const Picture a{2, 1, 3, {10, 20, 30, 0, 0, 0}, {}};
  const Picture b{2, 1, 3, {13, 20, 30, 99, 99, 99}, {}};
  EXPECT_DOUBLE_EQ(mean_square_difference(a, b, buffer, buffer), 3);
  EXPECT_THAT(difference(a, b).bytes, ElementsAre(116, 128, 128, 0, 0, 0));
}

// A checkerboard of single pixels, lighter and darker by `contrast`.
Picture checker(double middle, double contrast) {
  constexpr std::uint32_t kSide = 31;
  Picture picture{kSide, kSide, 3, {}, {}};
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    const double value = middle + (i % 2 == 0 ? contrast : -contrast);
    picture.bytes.insert(picture.bytes.end(), 3, static_cast<std::uint8_t>(value));
  }
  return picture;
}

// For a window in the middle, where means, variances and covariance are known.
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

Picture grey(std::uint8_t value) {
  return {16, 8, 3, std::vector<std::uint8_t>(std::size_t{3} * 16 * 8, value), {}};
}

TEST(SquareDifference, IsThatOfMeans) {
  Picture noisy = grey(100);
  for (std::size_t i = 0; i < noisy.bytes.size(); i += 6) {
    noisy.bytes[i] = 110;
    noisy.bytes[i + 3] = 90;
  }
  EXPECT_EQ(square_difference(grey(100), noisy), 0);
  Picture spot = grey(100);
  for (std::size_t y = 0; y < 8; ++y) {
    for (std::size_t x = 8; x < 16; ++x) spot.bytes[(y * 16 + x) * 3 + 2] = 104;
  }
  EXPECT_EQ(square_difference(grey(100), spot), 4);
}

// Grey with noise of up to 20 steps in both directions, other noise for another seed.
Picture grainy(std::uint32_t seed) {
  constexpr std::uint32_t kSide = 64;
  Picture picture{kSide, kSide, 3, {}, {}};
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    const std::uint32_t mixed = render::mix_bits(i, seed);
    for (int c = 0; c < 3; ++c) {
      picture.bytes.push_back(static_cast<std::uint8_t>(80 + (mixed >> 16U) % 41));
    }
  }
  return picture;
}

void brighten(Picture& picture, std::uint32_t side, std::uint8_t steps) {
  for (std::size_t y = 0; y < side; ++y) {
    for (std::size_t x = 0; x < side; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        std::uint8_t& byte = picture.bytes[(y * picture.width + x) * 3 + c];
        byte = static_cast<std::uint8_t>(byte + steps);
      }
    }
  }
}

TEST(GreatestDifference, IsAStepForEqualRandomNumbers) {
  Picture brighter = grainy(1);
  EXPECT_FALSE(greatest_difference(grainy(1), brighter).visible());
  brighten(brighter, 8, 1);
  EXPECT_FALSE(greatest_difference(grainy(1), brighter).visible());
  brighten(brighter, 8, 1);
  const SquareDifference found = greatest_difference(grainy(1), brighter);
  EXPECT_TRUE(found.visible());
  EXPECT_EQ(found.distance, 2);
  EXPECT_EQ(found.limit, 1);
}

// A change of one square beside noise that is the same in both pictures.
TEST(GreatestDifference, IgnoresNoiseThatBothPicturesHave) {
  Picture brighter = grainy(1);
  brighten(brighter, 8, 3);
  const SquareDifference found = greatest_difference(grainy(1), brighter, grainy(2));
  EXPECT_TRUE(found.visible());
  EXPECT_EQ(found.limit, 1);
}

TEST(GreatestDifference, IsBeyondTheNoiseOfOtherRandomNumbers) {
  Picture other = grainy(3);
  EXPECT_GT(greatest_difference(grainy(1), other).distance, 1);
  EXPECT_FALSE(greatest_difference(grainy(1), other, grainy(2)).visible());
  brighten(other, 32, 40);
  EXPECT_TRUE(greatest_difference(grainy(1), other, grainy(2)).visible());
}

TEST(PictureProof, AllowsThreeTimesTheNoiseAndAStep) {
  PictureProof proof;
  proof.add(grey(100), grey(102));
  EXPECT_EQ(proof.find_difference({grey(107)}), "");
  EXPECT_EQ(proof.find_difference({grey(108)}),
            "the picture would change by 8.0 of 255 steps; noise explains at most 7.0");
  proof.add(grey(50), grey(50));
  EXPECT_EQ(proof.find_difference({grey(100), grey(57)}), "");
  EXPECT_NE(proof.find_difference({grey(100), grey(58)}), "");
}

}  // namespace
}  // namespace gltfx::prove
