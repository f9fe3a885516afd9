// SPDX-License-Identifier: Apache-2.0
#include "uastc_levels.hpp"

#include <algorithm>
#include <utility>

#include "uastc_endpoints.hpp"

namespace gltfx::codec {

UastcLevels::UastcLevels(const UastcMode& mode) {
  const std::uint32_t digits = mode.digits == Digits::none    ? 1
                               : mode.digits == Digits::trits ? 3
                                                              : 5;
  std::vector<std::pair<std::uint8_t, std::uint8_t>> levels;  // value and code
  for (std::uint32_t digit = 0; digit < digits; ++digit) {
    for (std::uint32_t bits = 0; bits < 1U << mode.endpoint_bits; ++bits) {
      levels.emplace_back(unquantized_endpoint(mode.digits, mode.endpoint_bits, digit, bits),
                          static_cast<std::uint8_t>(digit << mode.endpoint_bits | bits));
    }
  }
  std::sort(levels.begin(), levels.end());
  for (const auto& [value, code] : levels) {
    values_.push_back(value);
    codes_.push_back(code);
  }
  last_ = static_cast<std::uint8_t>(levels.size() - 1);
  std::uint8_t rank = 0;
  for (std::size_t value = 0; value < below_.size(); ++value) {
    while (rank < last_ && levels[rank + 1U].first <= value) ++rank;
    below_[value] = rank;
  }
}

std::uint8_t UastcLevels::nearest(float value) const {
  const std::uint8_t low = below(value);
  const std::uint8_t high = above(low);
  return values_[high] - value < value - values_[low] ? high : low;
}

const UastcLevels& uastc_levels(std::size_t mode) {
  static const std::vector<UastcLevels> kAll = [] {
    std::vector<UastcLevels> all;
    for (std::size_t i = 0; i < kUastcModes; ++i) all.emplace_back(uastc_mode(i));
    return all;
  }();
  return kAll[mode];
}

}  // namespace gltfx::codec
