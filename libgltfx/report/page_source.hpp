// SPDX-License-Identifier: Apache-2.0
/// The pages without their data, which the build combines from page/.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace gltfx::report {

// Up to the block of data, and after it.
std::string_view page_begin();  ///< of the report
std::string_view page_end();
std::string_view compare_page_begin();  ///< of a comparison
std::string_view compare_page_end();

/// Adds JSON to the block of data, in which no '<' is left that could end it: in JSON a '<' can
/// only be inside a string.
inline void append_page_json(std::string& out, std::string_view json) {
  while (!json.empty()) {
    const std::size_t at = std::min(json.find('<'), json.size());
    out += json.substr(0, at);
    if (at == json.size()) return;
    out += "\\u003c";
    json.remove_prefix(at + 1);
  }
}

}  // namespace gltfx::report
