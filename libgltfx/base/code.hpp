// SPDX-License-Identifier: Apache-2.0
/// Codes of rules. What raises findings includes base/codes.hpp, which the build writes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gltfx {

/// The code of a rule: one value a page of schema/rules/.
enum class Code : std::uint16_t;

/// Name of the code, static storage: "NODE_EMPTY".
std::string_view code_name(Code code);

/// Whether a text has the form of a code: capitals, digits and underscores, "ACME_NODE_NAME".
constexpr bool has_code_form(std::string_view text) {
  constexpr std::size_t kLongest = 64;
  const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  if (text.empty() || text.size() > kLongest || !is_capital(text.front())) return false;
  bool has_underscore = false;
  char before = 0;
  for (const char c : text) {
    if (!is_capital(c) && !(c >= '0' && c <= '9') && (c != '_' || before == '_')) return false;
    has_underscore = has_underscore || c == '_';
    before = c;
  }
  return has_underscore && before != '_';
}

}  // namespace gltfx
