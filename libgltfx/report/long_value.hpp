// SPDX-License-Identifier: Apache-2.0
/// Texts of an asset as values of a machine format.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "json/writer.hpp"

namespace gltfx::report {

/// The text, or the beginning of a longer one with an ellipsis: a name of megabytes tells nobody
/// more, and would stand in every report.
inline std::string long_value(const std::string& text) {
  constexpr std::size_t kLongest = 1000;  // code points
  const std::size_t shown = bytes_of_code_points(text, kLongest);
  return shown == text.size() ? text : text.substr(0, shown) + "…";
}

/// A member whose value is an array of such texts.
inline void write_long_values(json::Writer& writer, std::string_view name,
                              const std::vector<std::string>& texts) {
  writer.key(name);
  writer.begin_array();
  for (const std::string& text : texts) writer.string(long_value(text));
  writer.end_array();
}

}  // namespace gltfx::report
