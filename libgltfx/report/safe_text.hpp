// SPDX-License-Identifier: Apache-2.0
/// Asset text for a terminal, a CI log or a value of a machine format. printable() of base removes
/// control characters; this removes the commands that build servers execute anywhere in a line.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "json/writer.hpp"

namespace gltfx::report {

/// printable(text) in which no `##[...]` (GitHub), `##vso[...]` (Azure) or `##teamcity[...]` is
/// left: the second '#' becomes "\u0023". Commands at the start of a line (`::error::`) are handled
/// by the formats: they begin no line with asset text.
std::string safe(std::string_view text);

/// The bytes [begin, end) of `whole` made safe, in the context of `whole`: adjacent parts together
/// equal safe(whole). Precondition: both are at the start of a code point.
std::string safe_part(std::string_view whole, std::size_t begin, std::size_t end);

/// safe() of a text of which at most `limit` code points are shown: a longer one is reduced to its
/// beginning and its end, with an ellipsis between them.
std::string safe_cut(std::string_view text, std::size_t limit);

/// The same for JSON text after position `from`, with JSON escapes of unprintable characters, which
/// keep the value. Precondition: valid JSON.
void defuse_json(std::string& json, std::size_t from);

/// The text, or the beginning of a longer one with an ellipsis: a name of megabytes is not useful,
/// and would be in every report.
inline std::string long_value(const std::string& text) {
  constexpr std::size_t kLongest = 1000;  // code points
  const std::size_t shown = bytes_of_code_points(text, kLongest);
  return shown == text.size() ? text : text.substr(0, shown) + "…";
}

/// An array of such texts.
inline void write_long_values(json::Writer& writer, const std::vector<std::string>& texts) {
  writer.begin_array();
  for (const std::string& text : texts) writer.string(long_value(text));
  writer.end_array();
}

/// A member whose value is such an array.
inline void write_long_values(json::Writer& writer, std::string_view name,
                              const std::vector<std::string>& texts) {
  writer.key(name);
  write_long_values(writer, texts);
}

}  // namespace gltfx::report
