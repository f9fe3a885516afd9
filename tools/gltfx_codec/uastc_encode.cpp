// SPDX-License-Identifier: Apache-2.0
// Tries modes, patterns and channels with a plane of their own, and keeps the smallest error. What
// no line can approximate better than the best block so far is not tried.
#include "uastc_encode.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "bit_writer.hpp"
#include "uastc_endpoints.hpp"
#include "uastc_hints.hpp"
#include "uastc_line.hpp"
#include "uastc_patterns.hpp"

namespace gltfx::codec {
namespace {

// How a block is divided: by a pattern, or by channels.
struct Division {
  UastcPattern pattern = 0;
  std::uint8_t index = 0;    // of the pattern
  std::size_t own = kAlpha;  // the channel of the second plane
};

struct Candidate {
  std::uint8_t mode = kUastcModes;
  Division division;
  std::array<UastcLine, 3> parts;  // by subset, or by plane
  float error = INFINITY;
};

std::size_t part_count(const UastcMode& mode) {
  return std::max<std::size_t>(mode.subsets, mode.planes);
}

// The texels and channels of each part.
std::array<LineTexels, 3> parts_of(const UastcMode& mode, const Division& division) {
  std::array<LineTexels, 3> parts;
  for (std::size_t i = 0; i < kBlockTexels; ++i) {
    for (std::size_t part = 0; part < part_count(mode); ++part) {
      const bool inside = mode.subsets == 1 || subset_of(division.pattern, i) == part;
      parts[part].mask[i / kLanes][i % kLanes] = inside ? 1 : 0;
    }
  }
  const std::uint8_t channels = mode.channels == 3 ? 3 : 4;
  for (std::uint8_t c = 0; c < channels; ++c) {
    for (std::size_t part = 0; part < part_count(mode); ++part) {
      if (mode.planes == 2 && (c == division.own) != (part == 1)) continue;
      parts[part].channels[parts[part].channel_count++] = c;
    }
  }
  return parts;
}

// --- Search ---

class Search {
 public:
  explicit Search(std::span<const Texel, kBlockTexels> texels) {
    for (std::size_t i = 0; i < kBlockTexels; ++i) {
      const Texel& texel = texels[i];
      for (std::size_t c = 0; c < 4; ++c) block_[c][i / kLanes][i % kLanes] = texel[c];
      opaque_ = opaque_ && texel[kAlpha] == 255;
      grey_ = grey_ && texel[0] == texel[1] && texel[0] == texel[2];
    }
  }

  Candidate run() {
    using Modes = std::initializer_list<std::uint8_t>;
    if (opaque_) {
      try_modes(Modes{0, 5, 18, 1}, {});
      try_planes(Modes{6});
    } else {
      try_modes(Modes{10, 12, 14}, {});
      try_planes(Modes{11, 13});
    }
    if (grey_) {
      try_modes(Modes{15}, {});
      try_modes(Modes{17}, {});
    }
    try_patterns();
    return best_;
  }

 private:
  // The modes have the same subsets, planes and channels.
  void try_modes(std::span<const std::uint8_t> modes, const Division& division) {
    if (best_.error <= 0) return;
    const UastcMode& first = uastc_mode(modes.front());
    const std::array<LineTexels, 3> parts = parts_of(first, division);
    const std::size_t count = part_count(first);
    std::array<LineEnds, 3> ends;
    for (std::size_t i = 0; i < count; ++i) ends[i] = extent_of(block_, parts[i]);
    for (const std::uint8_t mode : modes) {
      Candidate candidate;
      candidate.mode = mode;
      candidate.division = division;
      candidate.error = 0;
      for (std::size_t i = 0; i < count && candidate.error < best_.error; ++i) {
        candidate.parts[i] =
            fit_line(block_, parts[i], ends[i], uastc_levels(mode), uastc_mode(mode).weight_bits);
        candidate.error += candidate.parts[i].error;
      }
      if (candidate.error < best_.error) best_ = candidate;
    }
  }

  void try_planes(std::span<const std::uint8_t> modes) {
    const UastcMode& first = uastc_mode(modes.front());
    for (std::size_t own = first.channels; own-- > 0;) {
      Division division;
      division.own = own;
      if (distance_from_axis(block_, parts_of(first, division)[0]) < best_.error) {
        try_modes(modes, division);
      }
    }
  }

  void try_patterns() {
    if (best_.error <= 0) return;
    constexpr std::size_t kMostTries = 4;
    const std::uint8_t channels = opaque_ ? 3 : 4;
    std::size_t tries = 0;
    for (const RankedPattern& ranked : rank_patterns(block_, channels, best_.error)) {
      if (ranked.distance >= best_.error || ++tries > kMostTries) break;
      try_pattern(ranked);
    }
  }

  void try_pattern(const RankedPattern& ranked) {
    using Modes = std::initializer_list<std::uint8_t>;
    const Division division{uastc_patterns(ranked.mode)[ranked.index], ranked.index, kAlpha};
    if (!opaque_) {
      try_modes(Modes{9}, division);
      if (grey_) try_modes(Modes{16}, division);
    } else if (ranked.mode == 2) {
      try_modes(Modes{2, 4}, division);
    } else {
      try_modes(std::span(&ranked.mode, 1), division);
    }
  }

  BlockLanes block_{};
  bool opaque_ = true;
  bool grey_ = true;
  Candidate best_;
};

// --- Output ---

// The highest bit of the first weight of each part must be 0.
void turn_lines(const UastcMode& mode, Candidate& candidate) {
  const auto last = static_cast<std::uint8_t>((1U << mode.weight_bits) - 1);
  for (std::size_t part = 0; part < part_count(mode); ++part) {
    UastcLine& line = candidate.parts[part];
    std::size_t first = 0;
    while (mode.subsets > 1 && subset_of(candidate.division.pattern, first) != part) ++first;
    if (line.weights[first] <= last / 2) continue;
    for (auto& [low, high] : line.ranks) std::swap(low, high);
    for (std::uint8_t& weight : line.weights) weight = static_cast<std::uint8_t>(last - weight);
  }
}

// Codes of low and high of each channel of each subset.
std::vector<std::uint8_t> codes_of(const UastcMode& mode, const Candidate& candidate) {
  std::vector<std::uint8_t> codes;
  const UastcLevels& levels = uastc_levels(candidate.mode);
  for (std::size_t subset = 0; subset < mode.subsets; ++subset) {
    for (std::size_t stored = 0; stored < mode.channels; ++stored) {
      const std::size_t channel = mode.channels == 2 && stored == 1 ? kAlpha : stored;
      const bool second = mode.planes == 2 && channel == candidate.division.own;
      for (const std::uint8_t rank : candidate.parts[second ? 1 : subset].ranks[channel]) {
        codes.push_back(levels.code(rank));
      }
    }
  }
  return codes;
}

void write_endpoints(const UastcMode& mode, const std::vector<std::uint8_t>& codes,
                     BitWriter& bits) {
  if (mode.digits != Digits::none) {
    const bool trits = mode.digits == Digits::trits;
    const std::size_t most = trits ? 5 : 3;
    for (std::size_t first = 0; first < codes.size(); first += most) {
      const std::size_t group = std::min(most, codes.size() - first);
      std::uint32_t packed = 0;
      for (std::size_t i = first + group; i-- > first;) {
        packed = packed * (trits ? 3 : 5) + (codes[i] >> mode.endpoint_bits);
      }
      bits.put(packed, trits ? kTritBits[group] : kQuintBits[group]);
    }
  }
  for (const std::uint8_t code : codes) bits.put(code, mode.endpoint_bits);
}

void write_weights(const UastcMode& mode, const Candidate& candidate, BitWriter& bits) {
  std::uint32_t met = 0;  // one bit per subset
  for (std::size_t texel = 0; texel < kBlockTexels; ++texel) {
    const std::size_t subset = subset_of(candidate.division.pattern, texel);
    const unsigned count = mode.weight_bits - ((met >> subset & 1U) == 0 ? 1U : 0U);
    met |= 1U << subset;
    for (std::size_t plane = 0; plane < mode.planes; ++plane) {
      bits.put(candidate.parts[plane == 1 ? 1 : subset].weights[texel], count);
    }
  }
}

void write_candidate(Candidate candidate, std::span<const Texel, kBlockTexels> texels,
                     BitWriter& bits) {
  const UastcMode& mode = uastc_mode(candidate.mode);
  const UastcPrefix prefix = uastc_prefix(candidate.mode);
  bits.put(prefix.value, prefix.bits);
  write_uastc_hints(texels, mode, bits);
  if (mode.subsets > 1) bits.put(candidate.division.index, mode.pattern_bits);
  bits.put(static_cast<std::uint32_t>(candidate.division.own), mode.selector_bits);
  turn_lines(mode, candidate);
  write_endpoints(mode, codes_of(mode, candidate), bits);
  write_weights(mode, candidate, bits);
}

void write_solid(const Texel& color, BitWriter& bits) {
  const UastcPrefix prefix = uastc_prefix(kUastcSolidColor);
  bits.put(prefix.value, prefix.bits);
  for (const std::uint8_t channel : color) bits.put(channel, 8);
  write_solid_hints(color, bits);
}

}  // namespace

void encode_uastc_block(std::span<const Texel, 16> texels,
                        std::span<std::byte, kUastcBlockBytes> to) {
  std::fill(to.begin(), to.end(), std::byte{0});
  BitWriter bits(to);
  const bool solid = std::all_of(texels.begin(), texels.end(),
                                 [&](const Texel& texel) { return texel == texels[0]; });
  if (solid) return write_solid(texels[0], bits);
  write_candidate(Search(texels).run(), texels, bits);
}

}  // namespace gltfx::codec
