// SPDX-License-Identifier: Apache-2.0
/// The pages without their data, which the build combines from page/.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "report/safe_text.hpp"

namespace gltfx::report {

// Up to the block of data, and after it.
std::string_view page_begin();  ///< of the report
std::string_view page_end();
std::string_view compare_page_begin();  ///< of a comparison
std::string_view compare_page_end();

/// Adds JSON, or a part of it that ends between two values, to a block of data. No '<' is left that
/// could end the block, and no character that reorders or hides the text of the page: outside of
/// strings JSON has neither.
inline void append_page_json(std::string& out, std::string json) {
  defuse_json(json, 0);
  std::string_view left = json;
  while (!left.empty()) {
    const std::size_t at = std::min(left.find('<'), left.size());
    out += left.substr(0, at);
    if (at == left.size()) return;
    out += "\\u003c";
    left.remove_prefix(at + 1);
  }
}

}  // namespace gltfx::report
