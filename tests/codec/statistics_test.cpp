// SPDX-License-Identifier: Apache-2.0
#include "codec/statistics.hpp"

#include <random>

#include <gtest/gtest.h>

namespace gltfx::codec {
namespace {

template <typename T>
Image look_at(std::uint32_t channels, const std::vector<T>& values, bool normals = false) {
  Image image;
  image.width = static_cast<std::uint32_t>(values.size() / channels);
  image.height = 1;
  image.channels = channels;
  image.bits = sizeof(T) * 8;
  Statistics statistics(image, normals);
  statistics.add(std::as_bytes(std::span(values)));
  statistics.finish(image);
  return image;
}

// The same, computed value by value.
template <typename T>
void expect_as_counted(std::uint32_t channels, const std::vector<T>& values) {
  const Image image = look_at(channels, values);
  std::array<ChannelStatistics, 4> wanted{};
  for (std::uint32_t c = 0; c < channels; ++c) wanted[c].least = image.full();
  bool grey = true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    ChannelStatistics& channel = wanted[i % channels];
    channel.least = std::min<std::uint32_t>(channel.least, values[i]);
    channel.greatest = std::max<std::uint32_t>(channel.greatest, values[i]);
    channel.zeros += values[i] == 0 ? 1U : 0U;
    channel.fulls += values[i] == image.full() ? 1U : 0U;
    if (channels >= 3 && i % channels < 2) grey = grey && values[i] == values[i + 1];
  }
  for (std::uint32_t c = 0; c < channels; ++c) {
    EXPECT_EQ(image.statistics[c].least, wanted[c].least) << c;
    EXPECT_EQ(image.statistics[c].greatest, wanted[c].greatest) << c;
    EXPECT_EQ(image.statistics[c].zeros, wanted[c].zeros) << c;
    EXPECT_EQ(image.statistics[c].fulls, wanted[c].fulls) << c;
  }
  EXPECT_EQ(image.grey, grey);
}

template <typename T>
std::vector<T> noise(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  // Values at the ends of the range are as frequent as all others.
  std::uniform_int_distribution<int> kind(0, 3), value(1, 250);
  std::vector<T> values(count);
  for (T& each : values) {
    const int chosen = kind(random);
    each = chosen == 0   ? T{0}
           : chosen == 1 ? std::numeric_limits<T>::max()
                         : static_cast<T>(value(random));
  }
  return values;
}

TEST(Statistics, AreThoseOfPlainCounting) {
  for (std::uint32_t channels = 1; channels <= 4; ++channels) {
    for (const std::size_t texels : {1U, 11U, 12U, 13U, 48U, 49U, 257U, 13000U}) {
      expect_as_counted(channels, noise<std::uint8_t>(texels * channels, channels));
      expect_as_counted(channels, noise<std::uint16_t>(texels * channels, channels + 9));
    }
  }
}

TEST(Statistics, GreyMeansThatColoursAreEqualEverywhere) {
  for (const std::size_t texels : {1U, 30U, 5000U}) {
    for (std::uint32_t channels = 3; channels <= 4; ++channels) {
      std::vector<std::uint8_t> values;
      for (std::size_t i = 0; i < texels; ++i) {
        for (std::uint32_t c = 0; c < channels; ++c) {
          values.push_back(static_cast<std::uint8_t>(c == 3 ? i * 7 : i));
        }
      }
      EXPECT_TRUE(look_at(channels, values).grey);
      for (const std::size_t at : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
        std::vector<std::uint8_t> other = values;
        other[(texels - 1) * channels + at] ^= 1U;
        EXPECT_FALSE(look_at(channels, other).grey) << at;
      }
    }
  }
}

TEST(Statistics, AnAlphaThatDiffersFromColoursKeepsThemGrey) {
  EXPECT_TRUE(look_at<std::uint8_t>(4, {5, 5, 5, 200, 6, 6, 6, 0}).grey);
}

TEST(Statistics, NormalsThatAreUnitVectorsAreSound) {
  const Image image = look_at<std::uint8_t>(3, {128, 128, 255, 255, 128, 128, 128, 230, 204}, true);
  EXPECT_EQ(image.normals.not_unit, 0U);
  EXPECT_EQ(image.normals.inward, 0U);
  EXPECT_NEAR(image.normals.mean_length, 1, 0.01);
  EXPECT_NEAR(image.normals.steepest, 1, 0.001);
}

TEST(Statistics, NormalsAreShortFarOffOrInward) {
  const Image image = look_at<std::uint8_t>(
      4, {128, 128, 240, 9, 128, 128, 200, 9, 128, 128, 0, 9, 128, 128, 127, 9, 0, 0, 0, 9}, true);
  EXPECT_EQ(image.normals.vectors, 4U);   // black is not a vector
  EXPECT_EQ(image.normals.not_unit, 3U);  // lengths 0.88, 0.57 and 0
  EXPECT_EQ(image.normals.far_off, 2U);
  EXPECT_EQ(image.normals.inward, 1U);
  EXPECT_NEAR(image.normals.steepest, 1.0 / 255, 1e-6);
}

TEST(Statistics, NormalsAreOnlyLookedAtWhereThereAreThreeChannels) {
  EXPECT_EQ(look_at<std::uint8_t>(2, {0, 0, 0, 0}, true).normals.not_unit, 0U);
  EXPECT_EQ(look_at<std::uint8_t>(3, {0, 0, 0}, false).normals.not_unit, 0U);
}

}  // namespace
}  // namespace gltfx::codec
