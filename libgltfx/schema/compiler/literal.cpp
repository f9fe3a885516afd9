// SPDX-License-Identifier: Apache-2.0
#include "schema/compiler/literal.hpp"

namespace gltfx::schema {

std::string cpp_literal(std::string_view text) {
  std::string out = "\n    \"";
  std::size_t column = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\' || c == '?') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte >= 0x7F) {
      const char digits[] = {'\\', static_cast<char>('0' + (byte >> 6)),
                             static_cast<char>('0' + ((byte >> 3) & 7)),
                             static_cast<char>('0' + (byte & 7))};
      out.append(digits, 4);
    } else {
      out += c;
    }
    if (++column == 100) {
      out += "\"\n    \"";
      column = 0;
    }
  }
  return out + "\"";
}

}  // namespace gltfx::schema
