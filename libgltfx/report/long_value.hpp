// SPDX-License-Identifier: Apache-2.0
/// Texts of an asset as values of a machine format.
#pragma once

#include <string>

#include "base/text.hpp"

namespace gltfx::report {

/// The text, or the beginning of a longer one with an ellipsis: a name of megabytes tells nobody
/// more, and would stand in every report.
inline std::string long_value(const std::string& text) {
  constexpr std::size_t kLongest = 1000;  // code points
  const std::size_t shown = bytes_of_code_points(text, kLongest);
  return shown == text.size() ? text : text.substr(0, shown) + "…";
}

}  // namespace gltfx::report
