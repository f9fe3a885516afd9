// SPDX-License-Identifier: Apache-2.0
#include "uastc_line.hpp"

#include <algorithm>
#include <cmath>

namespace gltfx::codec {
namespace {

constexpr float kMostValue = 255;
constexpr float kFullWeight = 64;
// Sum of squares per channel of a block, below which rounding matters.
constexpr float kRounded = 16;

// Mean and covariance of texels.
struct Moments {
  float count = 0;
  std::array<float, 4> mean{};
  std::array<std::array<float, 4>, 4> products{};  // sums of products of differences
};

Moments moments_of(const BlockLanes& block, const LineTexels& texels) {
  Moments moments;
  Lanes count{};
  for (const Lanes& mask : texels.mask) count += mask;
  moments.count = sum_of(count);
  for (const std::uint8_t c : texels.used()) {
    Lanes sum{};
    for (std::size_t i = 0; i < kLaneGroups; ++i) sum += block[c][i] * texels.mask[i];
    moments.mean[c] = sum_of(sum) / moments.count;
  }
  for (std::size_t a = 0; a < texels.channel_count; ++a) {
    const std::uint8_t one = texels.channels[a];
    for (std::size_t b = 0; b <= a; ++b) {
      const std::uint8_t two = texels.channels[b];
      Lanes sum{};
      for (std::size_t i = 0; i < kLaneGroups; ++i) {
        sum += (block[one][i] - moments.mean[one]) * (block[two][i] - moments.mean[two]) *
               texels.mask[i];
      }
      moments.products[one][two] = moments.products[two][one] = sum_of(sum);
    }
  }
  return moments;
}

// The principal axis by power iteration, of length 1; 0 if all texels are equal.
struct Axis {
  std::array<float, 4> direction{};
  float variance = 0;  // sum of squares along it
};

Axis axis_of(const Moments& moments, const LineTexels& texels) {
  std::uint8_t widest = texels.channels[0];
  for (const std::uint8_t c : texels.used()) {
    if (moments.products[c][c] > moments.products[widest][widest]) widest = c;
  }
  Axis axis;
  if (moments.products[widest][widest] <= 0) return axis;
  axis.direction = moments.products[widest];
  constexpr int kIterations = 6;
  for (int i = 0; i < kIterations; ++i) {
    float square = 0;
    for (const std::uint8_t c : texels.used()) square += axis.direction[c] * axis.direction[c];
    const float scale = 1 / std::sqrt(square);
    for (const std::uint8_t c : texels.used()) axis.direction[c] *= scale;
    std::array<float, 4> next{};
    for (const std::uint8_t a : texels.used()) {
      for (const std::uint8_t b : texels.used()) {
        next[a] += moments.products[a][b] * axis.direction[b];
      }
    }
    axis.variance = 0;
    for (const std::uint8_t c : texels.used()) axis.variance += next[c] * axis.direction[c];
    if (i + 1 < kIterations) axis.direction = next;
  }
  return axis;
}

// Weights of 1 to 5 bits as 0 to 64.
const std::array<std::array<float, 32>, 6>& weight_values() {
  static const auto kValues = [] {
    std::array<std::array<float, 32>, 6> values{};
    for (unsigned bits = 1; bits < values.size(); ++bits) {
      for (std::uint32_t i = 0; i < 1U << bits; ++i) values[bits][i] = unquantized_weight(i, bits);
    }
    return values;
  }();
  return kValues;
}

class Fitter {
 public:
  Fitter(const BlockLanes& block, const LineTexels& texels, const UastcLevels& levels,
         unsigned weight_bits)
      : block_(block),
        texels_(texels),
        levels_(levels),
        values_(weight_values()[weight_bits]),
        last_weight_(static_cast<float>((1U << weight_bits) - 1)) {}

  // Rounds both endpoints, to different levels if none is exact.
  void start(const LineEnds& ends) {
    for (const std::uint8_t c : texels_.used()) {
      auto& [low, high] = line_.ranks[c];
      low = levels_.nearest(ends.low[c]);
      high = levels_.nearest(ends.high[c]);
      exact_[c] = ends.low[c] == ends.high[c] && levels_.value(low) == ends.low[c];
      if (low != high || exact_[c]) continue;
      low = levels_.below(ends.low[c]);
      high = levels_.above(low);
    }
    assign_weights();
  }

  // Chooses the endpoints that suit the weights best. False if nothing changes.
  bool refine() {
    Lanes low_low{}, low_high{}, high_high{};
    std::array<Lanes, kLaneGroups> lows, highs;
    std::array<Lanes, kLaneGroups> mixed{};  // 1: the weight is not that of an endpoint
    for (std::size_t i = 0; i < kLaneGroups; ++i) {
      highs[i] = weights_[i] * (1 / kFullWeight);
      lows[i] = (1 - highs[i]) * texels_.mask[i];
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::uint8_t weight = line_.weights[i * kLanes + lane];
        mixed[i][lane] = weight == 0 || static_cast<float>(weight) == last_weight_ ? 0 : 1;
      }
      highs[i] *= texels_.mask[i];
      low_low += lows[i] * lows[i];
      low_high += lows[i] * highs[i];
      high_high += highs[i] * highs[i];
    }
    const Sums sums{sum_of(low_low), sum_of(low_high), sum_of(high_high)};
    const float determinant = sums.low_low * sums.high_high - sums.low_high * sums.low_high;
    constexpr float kLeast = 1e-3F;
    if (determinant < kLeast) return false;
    const auto before = line_.ranks;
    for (const std::uint8_t c : texels_.used()) {
      if (exact_[c]) continue;
      Lanes low{}, high{};
      for (std::size_t i = 0; i < kLaneGroups; ++i) {
        const Lanes wanted = block_[c][i] + mixed[i] * (0.5F - block_[c][i] * (1 / 256.0F));
        low += lows[i] * wanted;
        high += highs[i] * wanted;
      }
      line_.ranks[c] = solve(sums, sum_of(low), sum_of(high), determinant);
    }
    if (line_.ranks == before) return false;
    assign_weights();
    return true;
  }

  const UastcLine& line() const { return line_; }

 private:
  // Sums over the texels of products of both shares.
  struct Sums {
    float low_low, low_high, high_high;
  };

  // The best of the levels around the solution. `low` and `high`: sums of the channel times shares.
  std::array<std::uint8_t, 2> solve(const Sums& sums, float low, float high,
                                    float determinant) const {
    const auto limited = [](float value) { return std::clamp(value, 0.0F, kMostValue); };
    const std::uint8_t first_low =
        levels_.below(limited((low * sums.high_high - high * sums.low_high) / determinant));
    const std::uint8_t first_high =
        levels_.below(limited((high * sums.low_low - low * sums.low_high) / determinant));
    std::array<std::uint8_t, 2> best{};
    float least = INFINITY;
    for (const std::uint8_t a : {first_low, levels_.above(first_low)}) {
      for (const std::uint8_t b : {first_high, levels_.above(first_high)}) {
        const float x = levels_.value(a);
        const float y = levels_.value(b);
        const float error = x * (x * sums.low_low + 2 * (y * sums.low_high - low)) +
                            y * (y * sums.high_high - 2 * high);
        if (error >= least) continue;
        least = error;
        best = {a, b};
      }
    }
    return best;
  }

  // The nearest weight of each texel, and the error.
  void assign_weights() {
    std::array<Lanes, kLaneGroups> along{};
    float square = 0;
    for (const std::uint8_t c : texels_.used()) {
      const float low = levels_.value(line_.ranks[c][0]);
      const float difference = levels_.value(line_.ranks[c][1]) - low;
      square += difference * difference;
      for (std::size_t i = 0; i < kLaneGroups; ++i) along[i] += (block_[c][i] - low) * difference;
    }
    const float scale = square > 0 ? last_weight_ / square : 0;
    for (std::size_t i = 0; i < kLaneGroups; ++i) {
      const Lanes steps = along[i] * scale + 0.5F;
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const float step = std::min(std::max(steps[lane], 0.0F), last_weight_);
        set_weight(i, lane, static_cast<std::uint8_t>(step));
      }
    }
    Lanes error{};
    for (std::size_t i = 0; i < kLaneGroups; ++i) error += error_of(i, weights_[i]);
    line_.error = sum_of(error);
    if (line_.error < kRounded * static_cast<float>(texels_.channel_count)) try_neighbors();
  }

  void set_weight(std::size_t group, std::size_t lane, std::uint8_t weight) {
    line_.weights[group * kLanes + lane] = weight;
    weights_[group][lane] = values_[weight];
  }

  // Where errors are small, rounding decides: the weights beside the nearest one may be better.
  void try_neighbors() {
    Lanes error{};
    const auto last = static_cast<int>(last_weight_);
    for (std::size_t i = 0; i < kLaneGroups; ++i) {
      Lanes least = error_of(i, weights_[i]);
      std::array<std::uint8_t, kLanes> best{};
      std::copy_n(line_.weights.begin() + i * kLanes, kLanes, best.begin());
      const auto start = best;
      for (const int by : {-1, 1}) {
        Lanes values{};
        std::array<std::uint8_t, kLanes> weights{};
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          weights[lane] = static_cast<std::uint8_t>(std::clamp(start[lane] + by, 0, last));
          values[lane] = values_[weights[lane]];
        }
        const Lanes errors = error_of(i, values);
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          if (errors[lane] >= least[lane]) continue;
          least[lane] = errors[lane];
          best[lane] = weights[lane];
        }
      }
      for (std::size_t lane = 0; lane < kLanes; ++lane) set_weight(i, lane, best[lane]);
      error += least;
    }
    line_.error = sum_of(error);
  }

  // The squared errors of four texels, with colours as decoders compute them.
  Lanes error_of(std::size_t group, const Lanes& weights) const {
    constexpr float kTo16Bits = 257;
    Lanes error{};
    for (const std::uint8_t c : texels_.used()) {
      const float low = levels_.value(line_.ranks[c][0]) * kTo16Bits;
      const float high = levels_.value(line_.ranks[c][1]) * kTo16Bits;
      const Lanes wide = (kFullWeight - weights) * low + weights * high + 32.0F;
      const Lanes value =
          __builtin_convertvector(__builtin_convertvector(wide * 0x1p-14F, IntLanes), Lanes);
      const Lanes off = (value - block_[c][group]) * texels_.mask[group];
      error += off * off;
    }
    return error;
  }

  const BlockLanes& block_;
  const LineTexels& texels_;
  const UastcLevels& levels_;
  const std::array<float, 32>& values_;
  float last_weight_;
  std::array<bool, 4> exact_{};               // the channel is constant and a level
  std::array<Lanes, kLaneGroups> weights_{};  // 0 to 64
  UastcLine line_;
};

}  // namespace

LineEnds extent_of(const BlockLanes& block, const LineTexels& texels) {
  const Moments moments = moments_of(block, texels);
  const Axis axis = axis_of(moments, texels);
  std::array<Lanes, kLaneGroups> along{};
  for (const std::uint8_t c : texels.used()) {
    for (std::size_t i = 0; i < kLaneGroups; ++i) {
      along[i] += (block[c][i] - moments.mean[c]) * axis.direction[c] * texels.mask[i];
    }
  }
  float least = 0;
  float greatest = 0;
  for (const Lanes& lanes : along) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      least = std::min(least, lanes[lane]);
      greatest = std::max(greatest, lanes[lane]);
    }
  }
  LineEnds ends;
  for (const std::uint8_t c : texels.used()) {
    ends.low[c] = std::clamp(moments.mean[c] + least * axis.direction[c], 0.0F, kMostValue);
    ends.high[c] = std::clamp(moments.mean[c] + greatest * axis.direction[c], 0.0F, kMostValue);
  }
  return ends;
}

float distance_from_axis(const BlockLanes& block, const LineTexels& texels) {
  const Moments moments = moments_of(block, texels);
  float variance = 0;
  for (const std::uint8_t c : texels.used()) variance += moments.products[c][c];
  return std::max(variance - axis_of(moments, texels).variance, 0.0F);
}

UastcLine fit_line(const BlockLanes& block, const LineTexels& texels, const LineEnds& ends,
                   const UastcLevels& levels, unsigned weight_bits) {
  constexpr int kRefinements = 2;
  Fitter fitter(block, texels, levels, weight_bits);
  fitter.start(ends);
  UastcLine best = fitter.line();
  for (int i = 0; i < kRefinements && best.error > 0 && fitter.refine(); ++i) {
    if (fitter.line().error < best.error) best = fitter.line();
  }
  return best;
}

}  // namespace gltfx::codec
