// SPDX-License-Identifier: Apache-2.0
/// From the spelling of a string or number to its value; whether a text is UTF-8.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/span.hpp"
#include "json/scan.hpp"

namespace gltfx::json {

/// A number at the start of a text.
struct LeadingNumber {
  double value = 0;      ///< as of number_value()
  std::size_t size = 0;  ///< bytes of the literal
};

/// read_leading_number() without the fast path.
LeadingNumber read_long_number(std::string_view text);

/// Reads the number literal with which `text` begins. Precondition: there is one, which obeys the
/// grammar.
inline LeadingNumber read_leading_number(std::string_view text) {
  double value = 0;
  const char* const behind = scan_short_decimal(text.data(), text.data() + text.size(), value);
  if (behind == nullptr) return read_long_number(text);
  return {value, static_cast<std::size_t>(behind - text.data())};
}

/// The nearest double of a number literal that obeys the grammar; an infinity when it is beyond a
/// double's range, a (signed) zero when it is too small for one.
inline double number_value(std::string_view literal) { return read_leading_number(literal).value; }

/// One escape sequence of a string.
struct Escape {
  char32_t value = 0;    ///< U+FFFD for half of a surrogate pair
  std::size_t size = 0;  ///< bytes of the text; 0: not an escape of JSON
  bool lone_surrogate = false;
};

/// Reads the escape at the backslash with which `text` begins. A surrogate is read together with
/// its partner.
Escape read_escape(std::string_view text);

/// The content of a string, given without its quotes, appended to `out`. An escape that JSON does
/// not have is copied unchanged.
void append_unescaped(std::string& out, std::string_view content);

/// One vectorised pass over the text.
bool is_utf8(std::string_view text);

/// The bytes of the first sequence that is not UTF-8: the lead and the tail bytes that follow it,
/// at most as many as it announces. Precondition: there is one.
Span first_invalid_utf8(std::string_view text);

}  // namespace gltfx::json
