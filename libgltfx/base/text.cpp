// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>

#include "base/utf8.hpp"

namespace gltfx {
namespace {

struct CodePoints {
  std::uint32_t first, last;
};

// Code points that move the cursor, end a line, reorder the text around them, or are not seen:
// those that Unicode calls controls, separators of lines, format characters (Cf) or default
// ignorable, letters that are drawn blank, private use and noncharacters (the last two of each
// plane: see is_unprintable()). Sorted.
constexpr std::array<CodePoints, 32> kUnprintable{{
    {0x0, 0x1F},        {0x7F, 0x9F},       {0xAD, 0xAD},       {0x34F, 0x34F},
    {0x600, 0x605},     {0x61C, 0x61C},     {0x6DD, 0x6DD},     {0x70F, 0x70F},
    {0x890, 0x891},     {0x8E2, 0x8E2},     {0x115F, 0x1160},   {0x17B4, 0x17B5},
    {0x180B, 0x180F},   {0x200B, 0x200F},   {0x2028, 0x202E},   {0x2060, 0x206F},
    {0x2800, 0x2800},   {0x3164, 0x3164},   {0xD800, 0xF8FF},   {0xFDD0, 0xFDEF},
    {0xFE00, 0xFE0F},   {0xFEFF, 0xFEFF},   {0xFFA0, 0xFFA0},   {0xFFF0, 0xFFFB},
    {0x110BD, 0x110BD}, {0x110CD, 0x110CD}, {0x13430, 0x1345F}, {0x1BCA0, 0x1BCA3},
    {0x1D159, 0x1D159}, {0x1D173, 0x1D17A}, {0xE0000, 0xE0FFF}, {0xF0000, 0x10FFFF},
}};

bool is_unprintable(std::uint32_t c) {
  if (c >= 0x20 && c < 0x7F) return false;
  if ((c & 0xFFFEU) == 0xFFFEU) return true;
  const auto* const behind = std::upper_bound(
      kUnprintable.begin(), kUnprintable.end(), c,
      [](std::uint32_t point, const CodePoints& range) { return point < range.first; });
  return behind != kUnprintable.begin() && c <= std::prev(behind)->last;
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
  const auto is_plain = [](char c) { return c >= ' ' && c <= '~'; };
  if (std::all_of(text.begin(), text.end(), is_plain)) return std::string(text);
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
  if (text.size() <= code_points) return text.size();
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
