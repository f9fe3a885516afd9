// SPDX-License-Identifier: Apache-2.0
#include "bake/sampler.hpp"

#include <array>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace gltfx::bake {
namespace {

// The first points of every draw fill each elementary interval of base 2 once.
TEST(Sampler, PairsAreEvenlySpread) {
  for (std::uint32_t draw = 0; draw < 3; ++draw) {
    for (const std::uint32_t columns : {1U, 2U, 4U, 8U, 16U, 32U, 64U}) {
      std::set<std::uint32_t> cells;
      for (std::uint32_t sample = 0; sample < 64; ++sample) {
        SampleStream stream(7, 99, sample);
        stream.seek(draw);
        const Float2 p = stream.next2();
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
    cells.insert(static_cast<std::uint32_t>(SampleStream(1, 2, sample).next() * 256));
  }
  EXPECT_EQ(cells.size(), 256U);
}

// Of products of draws, which would be biased were the draws coupled.
TEST(Sampler, DrawsAreIndependent) {
  double sum = 0;
  for (std::uint32_t pixel = 0; pixel < 64; ++pixel) {
    for (std::uint32_t sample = 0; sample < 64; ++sample) {
      SampleStream stream(3, pixel, sample);
      const Float2 p = stream.next2();
      const Float2 q = stream.next2();
      sum +=
          (p[0] - 0.5) * (q[0] - 0.5) + (p[1] - 0.5) * (q[1] - 0.5) + (p[0] - 0.5) * (p[1] - 0.5);
    }
  }
  EXPECT_NEAR(sum / 4096, 0, 0.006);
}

TEST(Sampler, TheSameCounterDrawsTheSame) {
  SampleStream a(1, 2, 3);
  SampleStream b(1, 2, 3);
  EXPECT_EQ(a.next2(), b.next2());
  EXPECT_EQ(a.next(), b.next());
  EXPECT_NE(SampleStream(1, 2, 3).next(), SampleStream(1, 3, 3).next());
  EXPECT_NE(SampleStream(1, 2, 3).next(), SampleStream(2, 2, 3).next());
  EXPECT_NE(SampleStream(1, 2, 3).key(), SampleStream(1, 2, 4).key());
}

}  // namespace
}  // namespace gltfx::bake
