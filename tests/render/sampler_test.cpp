// SPDX-License-Identifier: Apache-2.0
#include "render/sampler.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "render/path.hpp"

namespace gltfx::render {
namespace {

// The first points of every draw fill each elementary interval of base 2 once.
TEST(Sampler, PairsAreEvenlySpread) {
  for (std::uint32_t draw = 0; draw < 3; ++draw) {
    for (const std::uint32_t columns : {1U, 2U, 4U, 8U, 16U, 32U, 64U}) {
      std::set<std::uint32_t> cells;
      for (std::uint32_t sample = 0; sample < 64; ++sample) {
        const Float2 p = SampleStream(7, 99, sample).pair(draw);
        const auto rows = static_cast<float>(64 / columns);
        const auto x = static_cast<std::uint32_t>(p[0] * static_cast<float>(columns));
        const auto y = static_cast<std::uint32_t>(p[1] * rows);
        cells.insert(y * columns + x);
      }
      EXPECT_EQ(cells.size(), 64U) << columns << " columns, draw " << draw;
    }
  }
}

TEST(Sampler, SingleNumbersAreEvenlySpread) {
  std::set<std::uint32_t> cells;
  for (std::uint32_t sample = 0; sample < 256; ++sample) {
    cells.insert(static_cast<std::uint32_t>(SampleStream(1, 2, sample).single(0) * 256));
  }
  EXPECT_EQ(cells.size(), 256U);
}

// Of products of draws, which would be biased were the draws coupled.
TEST(Sampler, DrawsAreIndependent) {
  double sum = 0;
  for (std::uint32_t pixel = 0; pixel < 64; ++pixel) {
    for (std::uint32_t sample = 0; sample < 64; ++sample) {
      const SampleStream stream(3, pixel, sample);
      const Float2 p = stream.pair(0);
      const Float2 q = stream.pair(1);
      sum +=
          (p[0] - 0.5) * (q[0] - 0.5) + (p[1] - 0.5) * (q[1] - 0.5) + (p[0] - 0.5) * (p[1] - 0.5);
    }
  }
  EXPECT_NEAR(sum / 4096, 0, 0.006);
}

TEST(Sampler, PairsTogetherAreThoseOneByOne) {
  for (const std::uint32_t sample : {0U, 5U, 1000003U}) {
    const SampleStream stream(3, 77, sample);
    const auto parts = stream.pairs(6, 8, 20);
    const auto following = stream.following_pairs(2);
    for (std::uint32_t i = 0; i < kLanes; ++i) {
      EXPECT_EQ(parts[i], stream.pair(6, 8 + i, 20));
      EXPECT_EQ(following[i], SampleStream(3, 77, sample + i).pair(2));
      EXPECT_EQ(following[i], stream.later(i).pair(2));
    }
  }
}

// At the steps of stratified numbers and after them.
TEST(Sampler, PairsOfBranchesTogetherAreThoseOneByOne) {
  PathSampler sampler(SampleStream(3, 77, 5), 1);
  sampler = sampler.split(1, 3);
  for (int step = 0; step < 15; ++step, sampler.next_step()) {
    for (const std::uint32_t branches : {1U, 7U}) {
      const auto points = sampler.pairs(Dimension::environment, branches / 2, branches);
      for (std::uint32_t i = 0; i < std::min<std::uint32_t>(branches, kLanes); ++i) {
        const PathSampler branch = sampler.split(branches / 2 + i, branches);
        EXPECT_EQ(points[i], branch.pair(Dimension::environment));
      }
    }
  }
}

TEST(Sampler, TheSameCounterDrawsTheSame) {
  EXPECT_EQ(SampleStream(1, 2, 3).pair(4), SampleStream(1, 2, 3).pair(4));
  EXPECT_NE(SampleStream(1, 2, 3).single(4), SampleStream(1, 2, 3).single(5));
  EXPECT_NE(SampleStream(1, 2, 3).single(0), SampleStream(1, 3, 3).single(0));
  EXPECT_NE(SampleStream(1, 2, 3).single(0), SampleStream(2, 2, 3).single(0));
  EXPECT_NE(SampleStream(1, 2, 3).key(), SampleStream(1, 2, 4).key());
}

}  // namespace
}  // namespace gltfx::render
