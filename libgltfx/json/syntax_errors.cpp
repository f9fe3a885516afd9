// SPDX-License-Identifier: Apache-2.0
#include "json/syntax_errors.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/text.hpp"
#include "json/scan.hpp"
#include "json/token.hpp"

namespace gltfx::json {
namespace {

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

// Whether the next character behind a token, blanks apart, is a colon.
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

// The mistakes at the very beginning that tell what kind of file this is instead.
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

// Whether a word at the end of the text could have become one that JSON has.
bool is_cut_literal(std::string_view word) {
  constexpr std::array<std::string_view, 3> kLiterals{"true", "false", "null"};
  return std::any_of(kLiterals.begin(), kLiterals.end(), [&](std::string_view literal) {
    return literal.size() > word.size() && literal.substr(0, word.size()) == word;
  });
}

}  // namespace

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
