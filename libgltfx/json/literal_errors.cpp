// SPDX-License-Identifier: Apache-2.0
/// Explains errors in numbers, strings and the encoding.
#include <cctype>

#include <fmt/format.h>

#include "base/text.hpp"
#include "json/literals.hpp"
#include "json/scan.hpp"
#include "json/syntax_errors.hpp"

namespace gltfx::json {
namespace {

bool is_cut_number(std::string_view word) {
  const std::string completed = std::string(word) + '0';
  return scan_number(completed.data(), completed.data() + completed.size()).end != nullptr;
}

ParseError cut_string(std::uint32_t end, Span opening) {
  return {SyntaxError::unexpected_end,
          {end, end},
          "expected '\"' to close the string, found the end of the text",
          opening};
}

// Reason why a run of letters and digits is not a number.
std::string_view number_mistake(std::string_view word) {
  const std::string_view digits = word.substr(word.front() == '-' || word.front() == '+' ? 1 : 0);
  const std::string lower = lower_case(digits.substr(0, 8));
  const auto digit_at = [&](std::size_t i) { return i < digits.size() && is_a(kDigit, digits[i]); };
  if (lower == "nan" || lower == "inf" || lower == "infinity") {
    return "NaN and infinity are not allowed in JSON";
  }
  if (word.front() == '+') return "a leading plus sign is not allowed";
  if (digits.empty()) return "expected a digit after the minus sign";
  if (digits.front() == '.') return "expected a digit before the decimal point";
  if (lower.substr(0, 2) == "0x") return "hexadecimal numbers are not allowed in JSON";
  if (digits.front() == '0' && digit_at(1)) return "leading zeros are not allowed";
  const std::size_t point = digits.find('.');
  if (point != std::string_view::npos && !digit_at(point + 1)) {
    return "expected a digit after the decimal point";
  }
  const char last = digits.back();
  if (last == 'e' || last == 'E' || last == '+' || last == '-') {
    return "expected a digit in the exponent";
  }
  return "this is not a JSON number";
}

ParseError explain_escape(std::string_view text, Span opening, std::uint32_t at) {
  const auto end = static_cast<std::uint32_t>(text.size());
  std::uint32_t size = 1 + decode_utf8(text, at + 1).size;
  if (text[at + 1] != 'u') {
    return {SyntaxError::bad_escape,
            {at, at + size},
            fmt::format("found {}; write a backslash as \\\\; the other escapes are \\\" \\/ \\b "
                        "\\f \\n \\r \\t and \\uXXXX",
                        quoted(text.substr(at, size))),
            opening};
  }
  while (at + size < end && std::isxdigit(static_cast<unsigned char>(text[at + size]))) ++size;
  if (at + size == end) return cut_string(end, opening);
  return {SyntaxError::bad_escape,
          {at, at + size},
          fmt::format("found {}; expected four hexadecimal digits after \\u",
                      quoted(text.substr(at, size))),
          opening};
}

}  // namespace

ParseError explain_number(std::string_view text, std::uint32_t at) {
  const Span token = token_at(text, at);
  const std::string_view word = token.in(text);
  if (token.end == text.size() && is_cut_number(word)) {
    return {SyntaxError::unexpected_end,
            {token.end, token.end},
            fmt::format("the text ends inside the number {}", quoted(word)),
            {}};
  }
  return {SyntaxError::bad_number,
          token,
          fmt::format("found {}; {}", quoted(word), number_mistake(word)),
          {}};
}

ParseError explain_string(std::string_view text, std::uint32_t quote, std::uint32_t at) {
  const Span opening{quote, quote + 1};
  const auto end = static_cast<std::uint32_t>(text.size());
  if (at == end || (at + 1 == end && text[at] == '\\')) return cut_string(end, opening);
  const char c = text[at];
  if (c == '\n' || c == '\r') {
    return {SyntaxError::control_character,
            {at, at + 1},
            "the string contains a line break; is the closing '\"' missing?",
            opening};
  }
  if (c != '\\') {
    return {SyntaxError::control_character,
            {at, at + 1},
            fmt::format("found {} inside a string; write \\u{:04x}",
                        describe_token(text.substr(at, 1)), static_cast<unsigned char>(c)),
            opening};
  }
  return explain_escape(text, opening, at);
}

ParseError explain_invalid_utf8(std::string_view text) {
  const Span bytes = first_invalid_utf8(text);
  const std::string_view mark = text.substr(0, 2);
  const bool utf16 = mark == "\xFF\xFE" || mark == "\xFE\xFF";
  return {SyntaxError::invalid_utf8,
          bytes,
          fmt::format(
              "found {}; {}", quoted(bytes.in(text)),
              utf16 ? "the text looks like UTF-16; it must be UTF-8" : "the text must be UTF-8"),
          {}};
}

}  // namespace gltfx::json
