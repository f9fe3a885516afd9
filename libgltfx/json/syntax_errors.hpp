// SPDX-License-Identifier: Apache-2.0
/// Tokens of a text that may not be JSON, and errors that say what was found and what is expected.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/span.hpp"
#include "json/parse.hpp"

namespace gltfx::json {

/// The token at `at`: a string (to the end of its line when it is not closed), a comment, a run of
/// letters and digits, or one character. Empty at the end of the text.
Span token_at(std::string_view text, std::uint32_t at);

/// A token as it follows the word "found": "the word 'foo'". Printable. Precondition: not empty.
std::string describe_token(std::string_view token);

/// Whether a token begins like a comment of JavaScript, Python or YAML.
bool starts_comment(std::string_view token);

/// Whether a token consists of letters and is not a number. Precondition: not empty.
bool is_word(std::string_view token);

/// What the grammar allows at a place.
enum class Expected : std::uint8_t {
  root,              ///< the one value of the text
  value,             ///< after ':' or ','
  value_or_bracket,  ///< after '['
  name_or_brace,     ///< after '{'
  name,              ///< after ',' in an object
  colon,             ///< after a member's name
  comma_or_brace,    ///< after a member
  comma_or_bracket,  ///< after an element
  end,               ///< after the root value
};

/// The error for a token at `at` that is not `expected`. Typical mistakes are named.
ParseError explain_unexpected(std::string_view text, std::uint32_t at, Expected expected);

/// The error for a token at `at` that looks like a number, but is not one.
ParseError explain_number(std::string_view text, std::uint32_t at);

/// The error for a string that begins at `quote` and cannot continue at `at`: a bad escape, a
/// control character or the end of the text.
ParseError explain_string(std::string_view text, std::uint32_t quote, std::uint32_t at);

/// The error for a text that is not UTF-8. Precondition: it is not.
ParseError explain_invalid_utf8(std::string_view text);

}  // namespace gltfx::json
