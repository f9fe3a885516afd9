// SPDX-License-Identifier: Apache-2.0
#include "json/faults.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>

#include "base/text.hpp"
#include "base/utf8.hpp"
#include "json/scan.hpp"
#include "json/utf8.hpp"

namespace gltfx::json {
namespace {

constexpr std::string_view kWrapHint =
    "a glTF asset is one JSON object: wrap this text in '{' and '}'";

std::string_view expectation(Expected expected) {
  constexpr std::array<std::string_view, 9> kTexts{"a JSON value",
                                                   "a value",
                                                   "a value or ']'",
                                                   "a member name in double quotes or '}'",
                                                   "a member name in double quotes",
                                                   "':' behind the member name",
                                                   "',' or '}'",
                                                   "',' or ']'",
                                                   "the end of the text"};
  return kTexts[static_cast<std::size_t>(expected)];
}

bool wants_value(Expected expected) {
  return expected == Expected::root || expected == Expected::value ||
         expected == Expected::value_or_bracket;
}

bool wants_name(Expected expected) {
  return expected == Expected::name || expected == Expected::name_or_brace;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

bool starts_comment(std::string_view rest) {
  return rest.substr(0, 2) == "//" || rest.substr(0, 2) == "/*" || rest.substr(0, 1) == "#";
}

std::uint32_t comment_size(std::string_view rest) {
  const bool block = rest.substr(0, 2) == "/*";
  const std::size_t end = block ? rest.find("*/", 2) : rest.find_first_of("\r\n");
  return static_cast<std::uint32_t>(std::min(end, rest.size() - (block ? 2 : 0)) + (block ? 2 : 0));
}

// To the closing quote, or to the end of the line when there is none on it.
std::uint32_t string_size(std::string_view rest) {
  std::size_t at = 1;
  while (at < rest.size() && rest[at] != '"' && rest[at] != '\n' && rest[at] != '\r') {
    at += rest[at] == '\\' && at + 1 < rest.size() ? 2 : 1;
  }
  return static_cast<std::uint32_t>(at < rest.size() && rest[at] == '"' ? at + 1 : at);
}

std::uint32_t word_size(std::string_view rest) {
  const auto* end = std::find_if(rest.begin(), rest.end(), [](char c) { return !is_a(kWord, c); });
  return static_cast<std::uint32_t>(end - rest.begin());
}

// What stands at a place, to follow the word "found".
std::string found(std::string_view token) {
  if (token.empty()) return "the end of the text";
  const char c = token.front();
  if (c == '\0') return "a NUL byte";
  if (c == '"') return fmt::format("the string {}", quoted(token.substr(1, token.size() - 2)));
  if (starts_number(c)) return fmt::format("the number {}", quoted(token));
  if (is_a(kWord, c)) return fmt::format("the word {}", quoted(token));
  if (static_cast<unsigned char>(c) < 0x20) {
    return fmt::format("the control character U+{:04X}", static_cast<unsigned char>(c));
  }
  return quoted(token);
}

bool is_word(std::string_view token) {
  return !token.empty() && is_a(kWord, token.front()) && !starts_number(token.front());
}

// Whether the next character behind a token, blanks apart, is a colon.
bool colon_follows(std::string_view text, Span token) {
  const std::size_t next = text.find_first_not_of(" \t\r\n", token.end);
  return next != std::string_view::npos && text[next] == ':';
}

bool is_quote_like(std::string_view token) {
  return token == "'" || token == "`" || token == "\u2018" || token == "\u2019" ||
         token == "\u201C" || token == "\u201D" || token == "\u201E";
}

ParseFault explain_word(std::string_view text, Span token) {
  const std::string_view word = token.in(text);
  const std::string lower = lower_case(word);
  std::string detail;
  if (lower == "true" || lower == "false" || lower == "null") {
    detail = fmt::format("found {}; JSON writes it in lower case: {}", quoted(word), lower);
  } else if (lower == "none" || lower == "nil" || lower == "undefined") {
    detail = fmt::format("found {}; JSON has null, or the member is left out", quoted(word));
  } else {
    detail = fmt::format("expected a value, found the word {}; a string stands in double quotes",
                         quoted(word));
  }
  return {Fault::bad_literal, token, std::move(detail), {}};
}

// The mistakes at the very beginning that tell what kind of file this is instead.
std::string root_hint(std::string_view text, Span token) {
  const std::string_view word = token.in(text);
  if (colon_follows(text, token)) return std::string(kWrapHint);
  if (word.substr(0, 4) == "glTF") return "this is a binary glTF (GLB), not a JSON text";
  if (word == "<") return "this looks like HTML or XML, not like glTF";
  return {};
}

std::string general_detail(std::string_view text, Span token, Expected expected) {
  const std::string_view word = token.in(text);
  if (expected == Expected::end && (word == "}" || word == "]")) {
    return fmt::format("found '{}' behind the end of the JSON value: no bracket is open", word);
  }
  std::string detail = fmt::format("expected {}, found {}", expectation(expected), found(word));
  if (expected == Expected::end && word == std::string_view("\0", 1)) {
    detail += "; a GLB pads its JSON with blanks (0x20)";
  }
  if (is_word(word) && token.begin > 0 && text[token.begin - 1] == '"') {
    detail += "; a quotation mark inside a string is written \\\"";
  }
  return detail;
}

ParseFault explain_end(std::string_view text, Expected expected) {
  const auto end = static_cast<std::uint32_t>(text.size());
  const bool blank = text.find_first_not_of(" \t\r\n") == std::string_view::npos;
  std::string detail =
      blank ? "the text is empty"
            : fmt::format("expected {}, found the end of the text", expectation(expected));
  return {Fault::unexpected_end, {end, end}, std::move(detail), {}};
}

// Whether a word at the end of the text could have become one that JSON has.
bool is_cut_literal(std::string_view word) {
  constexpr std::array<std::string_view, 3> kLiterals{"true", "false", "null"};
  return std::any_of(kLiterals.begin(), kLiterals.end(), [&](std::string_view literal) {
    return literal.size() > word.size() && literal.substr(0, word.size()) == word;
  });
}

bool is_cut_number(std::string_view word) {
  const std::string completed = std::string(word) + '0';
  return scan_number(completed.data(), completed.data() + completed.size()).end != nullptr;
}

ParseFault cut_string(std::uint32_t end, Span opening) {
  return {Fault::unexpected_end,
          {end, end},
          "expected '\"' to close the string, found the end of the text",
          opening};
}

// Reason why a run of letters and digits is no number.
std::string_view number_mistake(std::string_view word) {
  const std::string_view digits = word.substr(word.front() == '-' || word.front() == '+' ? 1 : 0);
  const std::string lower = lower_case(digits.substr(0, 8));
  const auto digit_at = [&](std::size_t i) { return i < digits.size() && is_a(kDigit, digits[i]); };
  if (lower == "nan" || lower == "inf" || lower == "infinity") {
    return "JSON has neither NaN nor infinities";
  }
  if (word.front() == '+') return "a number has no plus sign";
  if (digits.empty()) return "a digit must follow the minus sign";
  if (digits.front() == '.') return "a digit must stand before the decimal point";
  if (lower.substr(0, 2) == "0x") return "JSON has no hexadecimal numbers";
  if (digits.front() == '0' && digit_at(1)) return "a number has no leading zeros";
  const std::size_t point = digits.find('.');
  if (point != std::string_view::npos && !digit_at(point + 1)) {
    return "a digit must follow the decimal point";
  }
  const char last = digits.back();
  if (last == 'e' || last == 'E' || last == '+' || last == '-') {
    return "a digit must follow in the exponent";
  }
  return "this is not a number of JSON";
}

}  // namespace

Span token_at(std::string_view text, std::uint32_t at) {
  const std::string_view rest = text.substr(at);
  if (rest.empty()) return {at, at};
  if (starts_comment(rest)) return {at, at + comment_size(rest)};
  if (rest.front() == '"') return {at, at + string_size(rest)};
  if (const std::uint32_t word = word_size(rest); word > 0) return {at, at + word};
  return {at, at + decode_utf8(text, at).size};
}

ParseFault explain_unexpected(std::string_view text, std::uint32_t at, Expected expected) {
  const Span token = token_at(text, at);
  if (token.empty()) return explain_end(text, expected);
  const std::string_view word = token.in(text);
  if (starts_comment(word)) {
    return {Fault::bad_literal, token, "JSON has no comments", {}};
  }
  if (is_quote_like(word)) {
    return {Fault::bad_literal,
            token,
            fmt::format("found {}; strings and names stand in double quotes (\")", quoted(word)),
            {}};
  }
  if (expected == Expected::root) {
    if (std::string hint = root_hint(text, token); !hint.empty()) {
      return {is_word(word) ? Fault::bad_literal : Fault::syntax, token, std::move(hint), {}};
    }
  }
  if (wants_name(expected) && is_a(kWord, word.front())) {
    return {Fault::bad_literal,
            token,
            fmt::format("found {}; a member name stands in double quotes", quoted(word)),
            {}};
  }
  if (wants_value(expected) && token.end == text.size() && is_cut_literal(word)) {
    return explain_end(text, expected);
  }
  if (wants_value(expected) && is_a(kWord, word.front())) {
    const std::string lower = lower_case(word.substr(0, 8));
    const bool number = word.front() == '+' || word.front() == '.' || lower == "nan" ||
                        lower == "inf" || lower == "infinity";
    return number ? explain_number(text, at) : explain_word(text, token);
  }
  const Fault fault = expected == Expected::end ? Fault::trailing_data : Fault::syntax;
  return {fault, token, general_detail(text, token, expected), {}};
}

ParseFault explain_number(std::string_view text, std::uint32_t at) {
  const Span token = token_at(text, at);
  const std::string_view word = token.in(text);
  if (token.end == text.size() && is_cut_number(word)) {
    return {Fault::unexpected_end,
            {token.end, token.end},
            fmt::format("the text ends inside the number {}", quoted(word)),
            {}};
  }
  return {Fault::bad_number,
          token,
          fmt::format("found {}; {}", quoted(word), number_mistake(word)),
          {}};
}

ParseFault explain_string(std::string_view text, std::uint32_t quote, std::uint32_t at) {
  const Span opening{quote, quote + 1};
  const auto end = static_cast<std::uint32_t>(text.size());
  if (at == end || (at + 1 == end && text[at] == '\\')) return cut_string(end, opening);
  const char c = text[at];
  if (c == '\n' || c == '\r') {
    return {Fault::control_character,
            {at, at + 1},
            "a string cannot run over the end of its line; is the closing '\"' missing?",
            opening};
  }
  if (c != '\\') {
    return {Fault::control_character,
            {at, at + 1},
            fmt::format("found {} inside a string; write \\u{:04x}", found(text.substr(at, 1)),
                        static_cast<unsigned char>(c)),
            opening};
  }
  std::uint32_t size = 1 + decode_utf8(text, at + 1).size;
  if (text[at + 1] != 'u') {
    return {Fault::bad_escape,
            {at, at + size},
            fmt::format("found {}; JSON has \\\" \\\\ \\/ \\b \\f \\n \\r \\t and \\uXXXX, and a "
                        "backslash itself is written \\\\",
                        quoted(text.substr(at, size))),
            opening};
  }
  while (size < 6 && at + size < end &&
         std::isxdigit(static_cast<unsigned char>(text[at + size]))) {
    ++size;
  }
  if (at + size == end) return cut_string(end, opening);
  return {Fault::bad_escape,
          {at, at + size},
          fmt::format("found {}; four hexadecimal digits must follow \\u",
                      quoted(text.substr(at, size))),
          opening};
}

ParseFault explain_invalid_utf8(std::string_view text) {
  const Span bytes = first_invalid_utf8(text);
  const std::string_view mark = text.substr(0, 2);
  const bool utf16 = mark == "\xFF\xFE" || mark == "\xFE\xFF";
  return {Fault::invalid_utf8,
          bytes,
          fmt::format("found {}; {}", quoted(bytes.in(text)),
                      utf16 ? "this looks like UTF-16, and glTF is UTF-8" : "this is not UTF-8"),
          {}};
}

}  // namespace gltfx::json
