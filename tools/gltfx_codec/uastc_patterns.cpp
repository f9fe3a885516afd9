// SPDX-License-Identifier: Apache-2.0
#include "uastc_patterns.hpp"

#include <algorithm>
#include <array>

namespace gltfx::codec {
namespace {

constexpr std::size_t kMostSums = 16;

// Sums over texels: their number, the channels, and products of two channels.
using PatternSums = std::array<Lanes, kMostSums / kLanes>;

std::size_t product_at(std::size_t a, std::size_t b) {  // a >= b
  return 5 + a * (a + 1) / 2 + b;
}

class Ranking {
 public:
  Ranking(const BlockLanes& block, std::uint8_t channels) : channels_(channels) {
    for (std::size_t i = 0; i < kBlockTexels; ++i) {
      std::array<float, kMostSums> terms{1};
      for (std::size_t a = 0; a < channels; ++a) {
        // Near 0, so that little is lost in differences of sums.
        constexpr float kMiddle = 128;
        terms[1 + a] = block[a][i / kLanes][i % kLanes] - kMiddle;
        for (std::size_t b = 0; b <= a; ++b) {
          if (product_at(a, b) < kMostSums) terms[product_at(a, b)] = terms[1 + a] * terms[1 + b];
        }
      }
      for (std::size_t group = 0; group < terms_[i].size(); ++group) {
        terms_[i][group] = load_lanes(terms.data() + group * kLanes);
        total_[group] += terms_[i][group];
      }
    }
  }

  float distance(UastcPattern pattern, std::size_t subsets) const {
    PatternSums rest = total_;
    float distance = 0;
    for (std::size_t subset = 1; subset < subsets; ++subset) {
      PatternSums sums{};
      for (std::size_t i = 0; i < kBlockTexels; ++i) {
        if (subset_of(pattern, i) != subset) continue;
        for (std::size_t group = 0; group < sums.size(); ++group) sums[group] += terms_[i][group];
      }
      for (std::size_t group = 0; group < sums.size(); ++group) rest[group] -= sums[group];
      distance += distance_of(sums);
    }
    return distance + distance_of(rest);
  }

 private:
  // Of texels from their principal axis: what the largest eigenvalue of the covariance leaves.
  float distance_of(const PatternSums& lanes) const {
    std::array<float, kMostSums> sums{};
    for (std::size_t group = 0; group < lanes.size(); ++group) {
      store_lanes(lanes[group], sums.data() + group * kLanes);
    }
    std::array<std::array<float, 4>, 4> products{};
    float variance = 0;
    std::size_t widest = 0;
    for (std::size_t a = 0; a < channels_; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        products[a][b] = products[b][a] =
            sums[product_at(a, b)] - sums[1 + a] * sums[1 + b] / sums[0];
      }
      variance += products[a][a];
      if (products[a][a] > products[widest][widest]) widest = a;
    }
    std::array<float, 4> axis = products[widest];
    float along = 0;
    constexpr int kIterations = 3;
    for (int i = 0; i < kIterations; ++i) {
      std::array<float, 4> next{};
      float square = 0;
      float scaled = 0;
      for (std::size_t a = 0; a < channels_; ++a) {
        for (std::size_t b = 0; b < channels_; ++b) next[a] += products[a][b] * axis[b];
        square += axis[a] * axis[a];
        scaled += next[a] * axis[a];
      }
      if (square <= 0) return std::max(variance, 0.0F);
      along = scaled / square;
      const float scale = 1 / std::max(variance, 1.0F);  // keeps numbers in range
      for (std::size_t a = 0; a < channels_; ++a) axis[a] = next[a] * scale;
    }
    return std::max(variance - along, 0.0F);
  }

  std::uint8_t channels_;
  std::array<PatternSums, kBlockTexels> terms_{};
  PatternSums total_{};
};

}  // namespace

std::vector<RankedPattern> rank_patterns(const BlockLanes& block, std::uint8_t channels,
                                         float limit) {
  const Ranking ranking(block, channels);
  std::vector<RankedPattern> ranked;
  const auto add = [&](std::uint8_t mode) {
    const auto patterns = uastc_patterns(mode);
    for (std::size_t i = 0; i < patterns.size(); ++i) {
      const float distance = ranking.distance(patterns[i], uastc_mode(mode).subsets);
      if (distance < limit) ranked.push_back({mode, static_cast<std::uint8_t>(i), distance});
    }
  };
  add(2);
  if (channels == 3) {
    add(7);
    add(3);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.distance < b.distance; });
  return ranked;
}

}  // namespace gltfx::codec
