// SPDX-License-Identifier: Apache-2.0
#include "json/syntax_errors.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/text.hpp"
#include "json/scan.hpp"

namespace gltfx::json {
namespace {

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

constexpr std::string_view kWrapHint = "expected a JSON object: enclose the text in '{' and '}'";

std::string_view expectation(Expected expected) {
  constexpr std::array<std::string_view, 9> kTexts{"a JSON value",
                                                   "a value",
                                                   "a value or ']'",
                                                   "a member name in double quotes or '}'",
                                                   "a member name in double quotes",
                                                   "':' after the member name",
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

// Whether the next character after a token, except blanks, is a colon.
bool colon_follows(std::string_view text, Span token) {
  const std::size_t next = text.find_first_not_of(" \t\r\n", token.end);
  return next != std::string_view::npos && text[next] == ':';
}

bool is_quote_like(std::string_view token) {
  return token == "'" || token == "`" || token == "\u2018" || token == "\u2019" ||
         token == "\u201C" || token == "\u201D" || token == "\u201E";
}

ParseError explain_word(std::string_view text, Span token) {
  const std::string_view word = token.in(text);
  const std::string lower = lower_case(word);
  std::string detail;
  if (lower == "true" || lower == "false" || lower == "null") {
    detail = fmt::format("found {}; in JSON it is lower case: {}", quoted(word), lower);
  } else if (lower == "none" || lower == "nil" || lower == "undefined") {
    detail = fmt::format("found {}; write null or remove the member", quoted(word));
  } else {
    detail = fmt::format("expected a value, found {}; strings need double quotes", quoted(word));
  }
  return {SyntaxError::bad_literal, token, std::move(detail), {}};
}

// Beginnings of a text that show another kind of file.
std::string root_hint(std::string_view text, Span token) {
  const std::string_view word = token.in(text);
  if (colon_follows(text, token)) {
    return std::string(kWrapHint) + (is_word(word) ? ", and the member name in double quotes" : "");
  }
  if (word.substr(0, 4) == "glTF") return "expected JSON text, found a binary glTF (GLB)";
  if (word == "<") return "expected JSON text, found HTML or XML";
  return {};
}

std::string general_detail(std::string_view text, Span token, Expected expected) {
  const std::string_view word = token.in(text);
  if (expected == Expected::end && (word == "}" || word == "]")) {
    return fmt::format("found '{}' without an opening bracket after the JSON value", word);
  }
  std::string detail =
      fmt::format("expected {}, found {}", expectation(expected), describe_token(word));
  if (expected == Expected::end && word == std::string_view("\0", 1)) {
    detail += "; pad the JSON chunk of a GLB with spaces (0x20)";
  }
  if (is_word(word) && token.begin > 0 && text[token.begin - 1] == '"') {
    detail += "; write a quotation mark inside a string as \\\"";
  }
  return detail;
}

ParseError explain_end(std::string_view text, Expected expected) {
  const auto end = static_cast<std::uint32_t>(text.size());
  const bool blank = text.find_first_not_of(" \t\r\n") == std::string_view::npos;
  std::string detail =
      blank ? "the text is empty"
            : fmt::format("expected {}, found the end of the text", expectation(expected));
  return {SyntaxError::unexpected_end, {end, end}, std::move(detail), {}};
}

// Whether a word at the end of the text is the beginning of a literal of JSON.
bool is_cut_literal(std::string_view word) {
  constexpr std::array<std::string_view, 3> kLiterals{"true", "false", "null"};
  return std::any_of(kLiterals.begin(), kLiterals.end(), [&](std::string_view literal) {
    return literal.size() > word.size() && literal.substr(0, word.size()) == word;
  });
}

}  // namespace

bool starts_comment(std::string_view rest) {
  return rest.substr(0, 2) == "//" || rest.substr(0, 2) == "/*" || rest.substr(0, 1) == "#";
}

bool is_word(std::string_view token) {
  return is_a(kWord, token.front()) && !starts_number(token.front());
}

Span token_at(std::string_view text, std::uint32_t at) {
  const std::string_view rest = text.substr(at);
  if (rest.empty()) return {at, at};
  if (starts_comment(rest)) return {at, at + comment_size(rest)};
  if (rest.front() == '"') return {at, at + string_size(rest)};
  if (const std::uint32_t word = word_size(rest); word > 0) return {at, at + word};
  return {at, at + decode_utf8(text, at).size};
}

std::string describe_token(std::string_view token) {
  const char c = token.front();
  if (c == '\0') return "a NUL byte";
  if (c == '"') {
    const bool closed = token.size() > 1 && token.back() == '"';
    return fmt::format("the string {}", quoted(token.substr(1, token.size() - (closed ? 2 : 1))));
  }
  if (starts_number(c)) return fmt::format("the number {}", quoted(token));
  if (is_a(kWord, c)) return fmt::format("the word {}", quoted(token));
  if (static_cast<unsigned char>(c) < 0x20) {
    return fmt::format("the control character U+{:04X}", static_cast<unsigned char>(c));
  }
  return quoted(token);
}

ParseError explain_unexpected(std::string_view text, std::uint32_t at, Expected expected) {
  const Span token = token_at(text, at);
  if (token.empty()) return explain_end(text, expected);
  const std::string_view word = token.in(text);
  if (starts_comment(word)) {
    return {SyntaxError::bad_literal, token, "comments are not allowed in JSON", {}};
  }
  if (is_quote_like(word)) {
    return {SyntaxError::bad_literal,
            token,
            fmt::format("found {}; strings and member names need double quotes (\")",
                        word == "'" ? std::string("a single quote") : quoted(word)),
            {}};
  }
  if (expected == Expected::root) {
    if (std::string hint = root_hint(text, token); !hint.empty()) {
      return {is_word(word) ? SyntaxError::bad_literal : SyntaxError::syntax,
              token,
              std::move(hint),
              {}};
    }
  }
  if (wants_name(expected) && is_a(kWord, word.front())) {
    return {SyntaxError::bad_literal,
            token,
            fmt::format("found {}; member names need double quotes", quoted(word)),
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
  const SyntaxError error =
      expected == Expected::end ? SyntaxError::trailing_data : SyntaxError::syntax;
  return {error, token, general_detail(text, token, expected), {}};
}

}  // namespace gltfx::json
