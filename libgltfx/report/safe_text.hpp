// SPDX-License-Identifier: Apache-2.0
/// Asset text on its way to a terminal, a CI log or a value of a machine format. printable() of
/// base takes the control characters out; here the words go that build servers obey wherever they
/// stand in a line.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "json/writer.hpp"

namespace gltfx::report {

/// printable(text) in which no `##[...]` (GitHub), `##vso[...]` (Azure) or `##teamcity[...]` is
/// left: the second '#' becomes "\u0023". A command that must stand at the start of a line
/// (`::error::`) is left to the formats: they begin no line with asset text.
std::string safe(std::string_view text);

/// The bytes [begin, end) of `whole` made safe, judged by all of `whole`: parts that touch give
/// together what safe(whole) gives. Precondition: both stand at the start of a code point.
std::string safe_part(std::string_view whole, std::size_t begin, std::size_t end);

/// safe() of a text of which at most `limit` code points are shown: of a longer one the beginning
/// and the end, with an ellipsis between them.
std::string safe_cut(std::string_view text, std::size_t limit);

/// The same for JSON text behind position `from`, with the JSON escapes of what is not printable:
/// they keep the value what it was. Precondition: valid JSON.
void defuse_json(std::string& json, std::size_t from);

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
