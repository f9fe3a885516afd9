// SPDX-License-Identifier: Apache-2.0
/// The loss of an encoded image.
#pragma once

#include <cmath>
#include <limits>
#include <optional>

namespace gltfx::codec {

/// The difference of two images over all texels and channels, in units of 1/255. An image without
/// alpha counts as opaque.
struct ImageDistance {
  double greatest = 0;
  double mean_square = 0;
  /// Of normal maps, degrees: 99 % of the vectors turn by at most this angle.
  std::optional<double> angle = {};

  /// Peak signal-to-noise ratio; infinite if there is no error.
  double decibels() const {
    constexpr double kGreatest = 255;
    if (mean_square == 0) return std::numeric_limits<double>::infinity();
    return 10 * std::log10(kGreatest * kGreatest / mean_square);
  }
  bool operator==(const ImageDistance&) const = default;
};

}  // namespace gltfx::codec
