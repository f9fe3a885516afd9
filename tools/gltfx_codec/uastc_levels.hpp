// SPDX-License-Identifier: Apache-2.0
/// The values that endpoints of a UASTC mode can have.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "uastc_modes.hpp"

namespace gltfx::codec {

/// Endpoint values in ascending order; a rank is a position in that order.
class UastcLevels {
 public:
  explicit UastcLevels(const UastcMode& mode);

  float value(std::uint8_t rank) const { return values_[rank]; }
  /// Digit and bits as one number, the bits lowest.
  std::uint8_t code(std::uint8_t rank) const { return codes_[rank]; }
  /// The greatest rank whose value is at most `value`, from 0 to 255.
  std::uint8_t below(float value) const { return below_[static_cast<std::size_t>(value)]; }
  std::uint8_t above(std::uint8_t rank) const {
    return rank == last_ ? rank : static_cast<std::uint8_t>(rank + 1);
  }
  std::uint8_t nearest(float value) const;

 private:
  std::vector<float> values_;
  std::vector<std::uint8_t> codes_;
  std::array<std::uint8_t, 256> below_{};
  std::uint8_t last_ = 0;
};

/// Precondition: as for uastc_mode().
const UastcLevels& uastc_levels(std::size_t mode);

}  // namespace gltfx::codec
