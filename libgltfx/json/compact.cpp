// SPDX-License-Identifier: Apache-2.0
#include "json/compact.hpp"

#include <cstddef>

namespace gltfx::json {

std::string compact(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      result += c;
      if (c == '\\' && i + 1 < text.size()) {
        result += text[++i];
      } else if (c == '"') {
        in_string = false;
      }
      continue;
    }
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r') continue;
    in_string = c == '"';
    result += c;
  }
  return result;
}

}  // namespace gltfx::json
