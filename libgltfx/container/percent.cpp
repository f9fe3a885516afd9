// SPDX-License-Identifier: Apache-2.0
#include "container/percent.hpp"

namespace gltfx::container {

void append_escaped(std::string& out, char c) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  const auto byte = static_cast<unsigned char>(c);
  out += '%';
  out += kDigits[byte >> 4U];
  out += kDigits[byte & 15U];
}

std::string percent_decode(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escape = is_escape(text, i);
    out += escape ? escaped_byte(text, i) : text[i];
    if (escape) i += 2;
  }
  return out;
}

std::string normalize_escapes(std::string_view text, std::string_view kept, char backslash) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i] == '\\' ? backslash : text[i];
    if (is_escape(text, i)) {
      const char byte = escaped_byte(text, i);
      is_unreserved(byte) ? out.push_back(byte) : append_escaped(out, byte);
      i += 2;
    } else if (is_path_character(c) || kept.find(c) != std::string_view::npos) {
      out += c;
    } else {
      append_escaped(out, c);
    }
  }
  return out;
}

}  // namespace gltfx::container
