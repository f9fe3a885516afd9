// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>

#include "base/utf8.hpp"

namespace gltfx {
namespace {

// Code points that move the cursor, end a line, reorder the text around them or hide in it.
bool is_unprintable(std::uint32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x61C || (c >= 0x200B && c <= 0x200F) ||
         (c >= 0x2028 && c <= 0x202E) || (c >= 0x2060 && c <= 0x206F) || c == 0xFEFF ||
         (c >= 0xFFF9 && c <= 0xFFFB) || (c >= 0xE0000 && c <= 0xE007F);
}

void append_printable(std::string& out, std::string_view text, std::size_t at, CodePoint point) {
  if (!point.valid) {
    fmt::format_to(std::back_inserter(out), "\\x{:02x}", point.value);
  } else if (point.value == '\t') {
    out += ' ';
  } else if (!is_unprintable(point.value)) {
    out += text.substr(at, point.size);
  } else if (point.value < 0x10000) {
    fmt::format_to(std::back_inserter(out), "\\u{:04x}", point.value);
  } else {
    fmt::format_to(std::back_inserter(out), "\\u{{{:x}}}", point.value);
  }
}

// std::to_chars pads an exponent to two digits: "1e-07" becomes "1e-7".
std::string without_exponent_padding(std::string_view digits) {
  const std::size_t exponent = digits.find('e');
  std::string text(digits.substr(0, exponent + 2));
  std::string_view rest = digits.substr(exponent + 2);
  while (rest.size() > 1 && rest.front() == '0') rest.remove_prefix(1);
  return text.append(rest);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const CodePoint point = decode_utf8(text, at);
    append_printable(out, text, at, point);
    at += point.size;
  }
  return out;
}

std::string quoted(std::string_view text, std::size_t limit) {
  const std::size_t shown = bytes_of_code_points(text, limit);
  return fmt::format("'{}{}'", printable(text.substr(0, shown)), shown < text.size() ? "…" : "");
}

std::size_t count_code_points(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t at = 0; at < text.size(); at += decode_utf8(text, at).size) ++count;
  return count;
}

std::size_t bytes_of_code_points(std::string_view text, std::size_t code_points) {
  std::size_t at = 0;
  for (; code_points > 0 && at < text.size(); --code_points) at += decode_utf8(text, at).size;
  return at;
}

std::string join_or(std::span<const std::string> items, std::size_t limit) {
  std::string text;
  const std::size_t shown = items.size() < limit ? items.size() : limit;
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += i + 1 == items.size() ? " or " : ", ";
    text += items[i];
  }
  if (const std::size_t rest = items.size() - shown; rest > 0) {
    fmt::format_to(std::back_inserter(text), "{}{} other{}", shown > 0 ? " or " : "", rest,
                   rest == 1 ? "" : "s");
  }
  return text;
}

std::string join_and(std::span<const std::string> items) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += i + 1 == items.size() ? " and " : ", ";
    text += items[i];
  }
  return text;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = ascii_lower(c);
  return lower;
}

std::string ending_of(std::string_view path) {
  return lower_case(std::filesystem::path(path).extension().native());
}

std::string number_text(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value < 0 ? "-Infinity" : "Infinity";
  // The bounds are ECMAScript's: between them people write a number without an exponent.
  const double magnitude = std::fabs(value);
  const bool fixed = magnitude == 0 || (magnitude >= 1e-6 && magnitude < 1e21);
  std::array<char, 64> buffer{};
  const auto result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                    fixed ? std::chars_format::fixed : std::chars_format::scientific);
  const std::string_view digits(buffer.data(),
                                static_cast<std::size_t>(result.ptr - buffer.data()));
  return fixed ? std::string(digits) : without_exponent_padding(digits);
}

}  // namespace gltfx
