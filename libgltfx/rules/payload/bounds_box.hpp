// SPDX-License-Identifier: Apache-2.0
/// Bounds of positions, as `min` and `max` of accessors state them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "model/accessor.hpp"
#include "model/node.hpp"

namespace gltfx::validate {

/// Elements beyond the limits of a phase are not checked, and may be NaN or infinite.
inline bool is_finite(const std::array<float, 3>& place) {
  return std::isfinite(place[0]) && std::isfinite(place[1]) && std::isfinite(place[2]);
}

struct BoundsBox {
  model::Vector3 least{kMost, kMost, kMost};
  model::Vector3 most{-kMost, -kMost, -kMost};

  void include(const BoundsBox& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      least[k] = std::min(least[k], other.least[k]);
      most[k] = std::max(most[k], other.most[k]);
    }
  }
  bool empty() const { return most[0] < least[0]; }
  /// The longest side; negative: empty.
  double width() const {
    return std::max({most[0] - least[0], most[1] - least[1], most[2] - least[2]});
  }
  /// The greatest absolute value of a coordinate; 0: empty.
  double reach() const {
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k) reach = std::max({reach, -least[k], most[k]});
    return empty() ? 0 : reach;
  }

 private:
  static constexpr double kMost = std::numeric_limits<double>::max() / 4;
};

/// Nothing: the accessor has no bounds of three numbers.
inline std::optional<BoundsBox> stated_box(const json::Document& document,
                                           const model::Accessor& accessor) {
  if (accessor.format.type != model::ElementType::vec3) return std::nullopt;
  const auto least = model::float_array<3>(document, accessor.min);
  const auto most = model::float_array<3>(document, accessor.max);
  if (!least || !most) return std::nullopt;
  // Bounds of normalized integers are integers, too.
  const bool scaled = accessor.format.normalized && model::is_integer(accessor.format.component);
  const double scale = scaled ? model::value_range(accessor.format.component).most : 1;
  BoundsBox box;
  for (std::size_t k = 0; k < 3; ++k) {
    box.least[k] = static_cast<double>((*least)[k]) / scale;
    box.most[k] = static_cast<double>((*most)[k]) / scale;
  }
  return box;
}

}  // namespace gltfx::validate
