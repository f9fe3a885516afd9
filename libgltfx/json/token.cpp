// SPDX-License-Identifier: Apache-2.0
#include "json/token.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "base/utf8.hpp"
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

}  // namespace gltfx::json
