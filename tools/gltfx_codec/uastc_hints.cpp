// SPDX-License-Identifier: Apache-2.0
// "UASTC ETC1 transcoding hints" and "UASTC ETC2 transcoding hints" (Khronos Data Format 1.3).
#include "uastc_hints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "basis_etc1s.hpp"

namespace gltfx::codec {
namespace {

constexpr std::uint8_t kBiasOfNone = 13;
constexpr int kBiases = 32;

// EAC modifiers of the steps, in ascending order.
constexpr std::array<std::array<std::int8_t, 8>, 16> kAlphaModifiers{{
    {-15, -9, -6, -3, 2, 5, 8, 14},
    {-13, -10, -7, -3, 2, 6, 9, 12},
    {-13, -8, -5, -2, 1, 4, 7, 12},
    {-13, -6, -4, -2, 1, 3, 5, 12},
    {-12, -8, -6, -3, 2, 5, 7, 11},
    {-11, -9, -7, -3, 2, 6, 8, 10},
    {-11, -8, -7, -4, 3, 6, 7, 10},
    {-11, -8, -5, -3, 2, 4, 7, 10},
    {-10, -8, -6, -2, 1, 5, 7, 9},
    {-10, -8, -5, -2, 1, 4, 7, 9},
    {-10, -8, -4, -2, 1, 3, 7, 9},
    {-10, -7, -5, -2, 1, 4, 6, 9},
    {-10, -7, -4, -3, 2, 3, 6, 9},
    {-10, -3, -2, -1, 0, 1, 2, 9},
    {-9, -8, -6, -4, 3, 5, 7, 8},
    {-9, -7, -5, -3, 2, 4, 6, 8},
}};

// The shift of a channel of a subblock's colour by a bias ("etc1_bias").
int shift_of(int bias, std::size_t subblock, std::size_t channel) {
  struct Single {
    int bias;
    std::size_t subblock, channel;
    int shift;
  };
  constexpr std::array<Single, 12> kSingles{{{2, 0, 0, -1},
                                             {5, 0, 1, -1},
                                             {6, 0, 2, -1},
                                             {7, 0, 0, 1},
                                             {11, 0, 1, 1},
                                             {15, 0, 2, 1},
                                             {18, 1, 0, -1},
                                             {19, 1, 1, -1},
                                             {20, 1, 2, -1},
                                             {21, 1, 0, 1},
                                             {24, 1, 1, 1},
                                             {8, 1, 2, 1}}};
  for (const Single& single : kSingles) {
    if (single.bias != bias) continue;
    return single.subblock == subblock && single.channel == channel ? single.shift : 0;
  }
  const bool second = subblock == 1;
  switch (bias) {
    case 10:
      return -2;
    case 27:
      return second ? 0 : -1;
    case 28:
      return second ? -1 : 1;
    case 29:
      return second ? 1 : 0;
    case 30:
      return second ? -1 : 0;
    case 31:
      return second ? 0 : 1;
    default: {
      constexpr std::array<int, 3> kDivisors{1, 3, 9};
      return bias / kDivisors[channel] % 3 - 1;
    }
  }
}

int shifted(int value, int shift, int limit) {
  if (value == 0) return shift == -2 ? 3 : shift + 1;
  if (value == limit) return value + shift - 1;
  const int sum = value + shift;
  return sum < 0 || sum > limit ? value - shift : sum;
}

// Texels by subblock.
struct Halves {
  std::array<std::array<Texel, kBlockTexels / 2>, 2> texels;
  std::array<std::array<int, 3>, 2> sums{};
};

Halves halves_of(std::span<const Texel, kBlockTexels> texels, bool flip) {
  Halves halves;
  std::array<std::size_t, 2> count{};
  for (std::size_t i = 0; i < kBlockTexels; ++i) {
    const std::size_t half = (flip ? i / kBlockExtent : i % kBlockExtent) / 2;
    halves.texels[half][count[half]++] = texels[i];
    for (std::size_t c = 0; c < 3; ++c) halves.sums[half][c] += texels[i][c];
  }
  return halves;
}

// Colours of both subblocks, 0 to 255.
using Bases = std::array<std::array<int, 3>, 2>;

Bases bases_of(const Halves& halves, bool difference, int bias) {
  const int limit = difference ? 31 : 15;
  Bases bases{};
  for (std::size_t half = 0; half < 2; ++half) {
    for (std::size_t c = 0; c < 3; ++c) {
      const int mean = (halves.sums[half][c] * limit + 1020) / 2040;
      bases[half][c] = bias < 0 ? mean : shifted(mean, shift_of(bias, half, c), limit);
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    if (difference) {
      bases[1][c] = bases[0][c] + std::clamp(bases[1][c] - bases[0][c], -4, 3);
      for (auto& base : bases) base[c] = base[c] << 3 | base[c] >> 2;
    } else {
      for (auto& base : bases) base[c] *= 17;
    }
  }
  return bases;
}

// The squared error of texels with a modifier each, of colours that end at 0 and 255.
int limited_error(const std::array<Texel, kBlockTexels / 2>& texels, const std::array<int, 3>& base,
                  const std::array<int, 2>& modifiers) {
  const auto [small, large] = modifiers;
  int error = 0;
  for (const Texel& texel : texels) {
    int least = std::numeric_limits<int>::max();
    for (const int by : {-large, -small, small, large}) {
      int squares = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const int off = std::clamp(base[c] + by, 0, 255) - texel[c];
        squares += off * off;
      }
      least = std::min(least, squares);
    }
    error += least;
  }
  return error;
}

// A subblock with the differences of its texels from a colour.
class Differences {
 public:
  Differences(const std::array<Texel, kBlockTexels / 2>& texels, const std::array<int, 3>& base)
      : texels_(texels), base_(base) {
    for (std::size_t i = 0; i < texels.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        const int off = texels[i][c] - base[c];
        sums_[i] += off;
        squares_ += off * off;
      }
    }
    const auto [lowest, highest] = std::minmax_element(base.begin(), base.end());
    room_ = std::min(*lowest, 255 - *highest);
  }

  // The squared error with a table of modifiers.
  int error(std::uint32_t table) const {
    const auto [small, large] = kEtc1Modifiers[table];
    if (room_ < large) return limited_error(texels_, base_, kEtc1Modifiers[table]);
    int error = squares_;
    for (const int sum : sums_) {
      const int size = 2 * std::abs(sum);
      error += std::min(small * (3 * small - size), large * (3 * large - size));
    }
    return error;
  }

 private:
  const std::array<Texel, kBlockTexels / 2>& texels_;
  const std::array<int, 3>& base_;
  std::array<int, kBlockTexels / 2> sums_{};
  int squares_ = 0;
  int room_ = 0;  // for modifiers, before a colour ends at 0 or 255
};

struct Etc1Hints {
  bool flip = false;
  bool difference = false;
  std::array<std::uint32_t, 2> tables{};
  int bias = kBiasOfNone;
  int error = std::numeric_limits<int>::max();
};

// Chooses tables that differ from those of `hints` by at most `reach`.
void choose_tables(const Halves& halves, std::uint32_t reach, Etc1Hints& hints) {
  const Bases bases = bases_of(halves, hints.difference, hints.bias);
  hints.error = 0;
  for (std::size_t half = 0; half < 2; ++half) {
    const Differences differences(halves.texels[half], bases[half]);
    int least = std::numeric_limits<int>::max();
    const std::uint32_t start = hints.tables[half];
    for (std::uint32_t table = start - std::min(start, reach);
         table < kEtc1Modifiers.size() && table <= start + reach; ++table) {
      const int error = differences.error(table);
      if (error >= least) continue;
      least = error;
      hints.tables[half] = table;
    }
    hints.error += least;
  }
}

void choose_bias(const Halves& halves, Etc1Hints& best) {
  const Etc1Hints unbiased = best;
  for (int bias = 0; bias < kBiases; ++bias) {
    Etc1Hints hints = unbiased;
    hints.bias = bias;
    choose_tables(halves, 1, hints);
    if (hints.error < best.error) best = hints;
  }
}

// `biased`: the block has a bias.
Etc1Hints find_etc1_hints(std::span<const Texel, kBlockTexels> texels, bool biased) {
  const std::array<Halves, 2> halves{halves_of(texels, false), halves_of(texels, true)};
  Etc1Hints best;
  for (const bool flip : {false, true}) {
    for (const bool difference : {false, true}) {
      Etc1Hints hints;
      hints.flip = flip;
      hints.difference = difference;
      hints.bias = biased ? kBiasOfNone : -1;
      choose_tables(halves[flip ? 1 : 0], kEtc1Modifiers.size(), hints);
      if (hints.error < best.error) best = hints;
    }
  }
  if (biased) choose_bias(halves[best.flip ? 1 : 0], best);
  return best;
}

// Table and multiplier of EAC.
std::uint32_t find_alpha_hint(std::span<const Texel, kBlockTexels> texels) {
  int least = 255;
  int greatest = 0;
  for (const Texel& texel : texels) {
    least = std::min<int>(least, texel[kAlpha]);
    greatest = std::max<int>(greatest, texel[kAlpha]);
  }
  constexpr std::uint32_t kSolid = 13U | 1U << 4U;
  if (least == greatest) return kSolid;
  std::uint32_t best = kSolid;
  int best_error = std::numeric_limits<int>::max();
  for (std::uint32_t table = 0; table < kAlphaModifiers.size(); ++table) {
    const auto& modifiers = kAlphaModifiers[table];
    const int span = modifiers.back() - modifiers.front();
    const float range = static_cast<float>(greatest - least);
    const auto center = static_cast<int>(std::lround(
        static_cast<float>(least) - range * modifiers.front() / static_cast<float>(span)));
    const auto multiplier = static_cast<int>(std::lround(range / static_cast<float>(span)));
    for (int by = std::max(multiplier - 1, 1); by <= std::min(multiplier + 1, 15); ++by) {
      int error = 0;
      for (const Texel& texel : texels) {
        int nearest = 255;
        for (const int modifier : modifiers) {
          const int value = std::clamp(center + modifier * by, 0, 255);
          nearest = std::min(nearest, std::abs(value - texel[kAlpha]));
        }
        error += nearest * nearest;
      }
      if (error >= best_error) continue;
      best_error = error;
      best = table | static_cast<std::uint32_t>(by) << 4U;
    }
  }
  return best;
}

// An ETC1 block of one colour.
struct SolidHints {
  bool difference = true;  // a colour of five bits, not four
  std::uint32_t table = 0;
  std::uint32_t step = 0;  // of the modifiers, from dark to bright
  std::array<std::uint32_t, 3> base{};
  int error = std::numeric_limits<int>::max();
};

void choose_solid_base(const Texel& color, SolidHints& hints) {
  const auto [small, large] = kEtc1Modifiers[hints.table];
  const int by = std::array<int, 4>{-large, -small, small, large}[hints.step];
  const int limit = hints.difference ? 31 : 15;
  hints.error = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const int near = std::clamp(color[c] - by, 0, 255) * limit / 255;
    int least = std::numeric_limits<int>::max();
    for (int base = near; base <= std::min(near + 1, limit); ++base) {
      const int value = hints.difference ? base << 3 | base >> 2 : base * 17;
      const int off = std::clamp(value + by, 0, 255) - color[c];
      if (off * off >= least) continue;
      least = off * off;
      hints.base[c] = static_cast<std::uint32_t>(base);
    }
    hints.error += least;
  }
}

}  // namespace

void write_uastc_hints(std::span<const Texel, 16> texels, const UastcMode& mode, BitWriter& bits) {
  const bool biased = mode.has_etc1_bias();
  const Etc1Hints hints = find_etc1_hints(texels, biased);
  bits.put(0, biased ? 2 : 1);  // for BC1
  bits.put(hints.flip ? 1 : 0, 1);
  bits.put(hints.difference ? 1 : 0, 1);
  for (const std::uint32_t table : hints.tables) bits.put(table, 3);
  if (biased) bits.put(static_cast<std::uint32_t>(hints.bias), 5);
  if (mode.channels != 3) bits.put(find_alpha_hint(texels), 8);
}

void write_solid_hints(const Texel& color, BitWriter& bits) {
  SolidHints best;
  for (const bool difference : {true, false}) {
    for (std::uint32_t table = 0; table < kEtc1Modifiers.size(); ++table) {
      for (std::uint32_t step = 0; step < 4; ++step) {
        SolidHints hints{difference, table, step, {}, 0};
        choose_solid_base(color, hints);
        if (hints.error < best.error) best = hints;
      }
    }
  }
  bits.put(best.difference ? 1 : 0, 1);
  bits.put(best.table, 3);
  bits.put(best.step, 2);
  for (const std::uint32_t channel : best.base) bits.put(channel, 5);
}

}  // namespace gltfx::codec
