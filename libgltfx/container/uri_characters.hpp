// SPDX-License-Identifier: Apache-2.0
/// Characters and escapes of RFC 3986, shared by the readers of relative and data URIs.
#pragma once

#include <cstddef>
#include <string_view>

#include "base/text.hpp"

namespace gltfx::container {

inline constexpr std::string_view kDataScheme = "data:";

constexpr bool is_alpha(char c) { return ascii_lower(c) >= 'a' && ascii_lower(c) <= 'z'; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
/// RFC 3986 section 2.3: means the same escaped or not.
constexpr bool is_unreserved(char c) {
  return is_alpha(c) || is_digit(c) || c == '-' || c == '.' || c == '_' || c == '~';
}
/// RFC 3986 section 3.3: may stand in a path as it is, '/' included.
constexpr bool is_path_character(char c) {
  return is_unreserved(c) || std::string_view("!$&'()*+,;=:@/").find(c) != std::string_view::npos;
}
/// C0 controls and DEL.
constexpr bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7f'; }

/// 0 to 15, or -1.
constexpr int hex_value(char c) {
  if (is_digit(c)) return c - '0';
  const char low = ascii_lower(c);
  return low >= 'a' && low <= 'f' ? low - 'a' + 10 : -1;
}

/// Whether `text` has a whole percent escape at `at`.
constexpr bool is_escape(std::string_view text, std::size_t at) {
  return text[at] == '%' && text.size() - at > 2 && hex_value(text[at + 1]) >= 0 &&
         hex_value(text[at + 2]) >= 0;
}
/// The byte that the escape at `at` stands for.
constexpr char escaped_byte(std::string_view text, std::size_t at) {
  return static_cast<char>(hex_value(text[at + 1]) * 16 + hex_value(text[at + 2]));
}

/// Where the first '%' stands that begins no escape, or npos.
std::size_t find_bad_escape(std::string_view text);

/// Whether it begins with "data:", in whatever case.
bool has_data_scheme(std::string_view uri);

}  // namespace gltfx::container
