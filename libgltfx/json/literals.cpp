// SPDX-License-Identifier: Apache-2.0
#include "json/literals.hpp"

#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>

#ifndef __EMSCRIPTEN__
#include <simdjson.h>
#endif

#include "base/number.hpp"
#include "base/text.hpp"
#include "json/scan.hpp"

namespace gltfx::json {
namespace {

// Whether a literal outside the range of doubles is too large (else too small). True when the first
// digit that is not zero has a weight of one or more. Precondition: there is one, since zero is in
// the range.
bool is_large(std::string_view literal) {
  const std::size_t mark = literal.find_first_of("eE");
  const std::string_view mantissa = literal.substr(0, mark);
  const std::size_t first = mantissa.find_first_of("123456789");
  const std::size_t point =
      mantissa.find('.') == std::string_view::npos ? mantissa.size() : mantissa.find('.');
  const auto weight = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first);
  if (mark == std::string_view::npos) return weight > 0;
  std::string_view digits = literal.substr(mark + 1);
  if (digits.front() == '+') digits.remove_prefix(1);
  std::int64_t exponent = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
  if (read.ec == std::errc::result_out_of_range) return digits.front() != '-';
  return exponent > -weight;
}

// Four hexadecimal digits, or nothing.
std::optional<std::uint32_t> hex4(std::string_view text) {
  std::uint32_t value = 0;
  if (text.size() < 4) return std::nullopt;
  const auto read = std::from_chars(text.data(), text.data() + 4, value, 16);
  if (read.ptr != text.data() + 4) return std::nullopt;
  return value;
}

bool is_high_surrogate(std::uint32_t unit) { return unit >= 0xD800 && unit < 0xDC00; }
bool is_low_surrogate(std::uint32_t unit) { return unit >= 0xDC00 && unit < 0xE000; }

Escape read_unicode_escape(std::string_view text) {
  constexpr std::size_t kSize = 6;
  const auto unit = hex4(text.substr(2));
  if (!unit) return {};
  if (is_high_surrogate(*unit) && text.substr(kSize, 2) == "\\u") {
    const auto low = hex4(text.substr(kSize + 2));
    if (low && is_low_surrogate(*low)) {
      return {0x10000 + ((*unit - 0xD800) << 10) + (*low - 0xDC00), 2 * kSize, false};
    }
  }
  if (is_high_surrogate(*unit) || is_low_surrogate(*unit)) return {0xFFFD, kSize, true};
  return {*unit, kSize, false};
}

#ifndef __EMSCRIPTEN__
// simdjson selects the best implementation at its first call, in functions that end the program if
// memory is missing. So the first call is made when the program is loaded.
[[maybe_unused]] const bool kReady = simdjson::validate_utf8("", 0);
#endif

}  // namespace

LeadingNumber read_long_number(std::string_view text) {
  std::size_t size = 1;
  while (size < text.size() && is_a(kWord, text[size])) ++size;
  const std::string_view literal = text.substr(0, size);
  double value = 0;
  const auto read = read_double(literal.data(), literal.data() + size, value);
  if (read.ec == std::errc::result_out_of_range) {
    value = is_large(literal) ? std::numeric_limits<double>::infinity() : 0.0;
    if (literal.front() == '-') value = -value;
  }
  return {value, size};
}

Escape read_escape(std::string_view text) {
  constexpr std::string_view kLetters = "\"\\/bfnrt";
  constexpr std::string_view kMeanings = "\"\\/\b\f\n\r\t";
  if (text.size() < 2) return {};
  if (text[1] == 'u') return read_unicode_escape(text);
  const std::size_t letter = kLetters.find(text[1]);
  if (letter == std::string_view::npos) return {};
  return {static_cast<char32_t>(kMeanings[letter]), 2, false};
}

void append_unescaped(std::string& out, std::string_view content) {
  while (!content.empty()) {
    const std::size_t plain = content.find('\\');
    out += content.substr(0, plain);
    if (plain == std::string_view::npos) return;
    content.remove_prefix(plain);
    const Escape escape = read_escape(content);
    if (escape.size == 0) {
      out += content.front();
      content.remove_prefix(1);
      continue;
    }
    append_utf8(out, escape.value);
    content.remove_prefix(escape.size);
  }
}

#ifdef __EMSCRIPTEN__
// simdjson has no faster code for WebAssembly, and adds an unused parser: 12 kB compressed.
bool is_utf8(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    if (text.size() - at >= 8 && (load8(text.data() + at) & kHighs) == 0) {
      at += 8;
      continue;
    }
    const CodePoint point = decode_utf8(text, at);
    if (!point.valid) return false;
    at += point.size;
  }
  return true;
}
#else
bool is_utf8(std::string_view text) { return simdjson::validate_utf8(text.data(), text.size()); }
#endif

Span first_invalid_utf8(std::string_view text) {
  std::size_t at = 0;
  for (CodePoint point; at < text.size(); at += point.size) {
    point = decode_utf8(text, at);
    if (!point.valid) break;
  }
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t announced = lead < 0xC0 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  std::size_t end = at + 1;
  while (end < text.size() && end - at < announced && (text[end] & 0xC0) == 0x80) ++end;
  return {static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(end)};
}

}  // namespace gltfx::json
