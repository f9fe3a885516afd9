// SPDX-License-Identifier: Apache-2.0
/// Characters of URIs and their percent escapes (RFC 3986 section 2).
#pragma once

#include <string>
#include <string_view>

#include "base/hex.hpp"
#include "base/text.hpp"

namespace gltfx::container {

constexpr bool is_alpha(char c) { return ascii_lower(c) >= 'a' && ascii_lower(c) <= 'z'; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
/// RFC 3986 section 2.3: means the same escaped or not.
constexpr bool is_unreserved(char c) {
  return is_alpha(c) || is_digit(c) || c == '-' || c == '.' || c == '_' || c == '~';
}
/// RFC 3986 section 3.3: allowed unescaped in a path, '/' included.
constexpr bool is_path_character(char c) {
  return is_unreserved(c) || std::string_view("!$&'()*+,;=:@/").find(c) != std::string_view::npos;
}

/// Whether `text` has a whole percent escape at `at`.
constexpr bool is_escape(std::string_view text, std::size_t at) {
  return text[at] == '%' && text.size() - at > 2 && hex_value(text[at + 1]) >= 0 &&
         hex_value(text[at + 2]) >= 0;
}
/// The byte that the escape at `at` encodes.
constexpr char escaped_byte(std::string_view text, std::size_t at) {
  return static_cast<char>(hex_value(text[at + 1]) * 16 + hex_value(text[at + 2]));
}

void append_escaped(std::string& out, char c);

/// Decodes percent escapes; a '%' that does not begin one is kept.
std::string percent_decode(std::string_view text);

/// RFC 3986 section 6.2.2: escapes of unreserved characters are decoded, the others get upper case,
/// and characters that are neither path characters nor in `kept` are escaped. '\\' becomes
/// `backslash` first.
std::string normalize_escapes(std::string_view text, std::string_view kept = {},
                              char backslash = '/');

}  // namespace gltfx::container
