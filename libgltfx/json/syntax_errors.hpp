// SPDX-License-Identifier: Apache-2.0
/// What stands at a place of a text that may be no JSON at all, and the error that says so and what
/// should.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/span.hpp"
#include "json/parse.hpp"

namespace gltfx::json {

/// The token at `at`, whatever it is: a string (to the end of its line when it is not closed), a
/// comment, a run of letters and digits, or one character. Empty at the end of the text.
Span token_at(std::string_view text, std::uint32_t at);

/// A token as it follows the word "found": "the word 'foo'". Printable. Precondition: not empty.
std::string describe_token(std::string_view token);

/// Whether a token begins like a comment of JavaScript, Python or YAML.
bool starts_comment(std::string_view token);

/// Whether a token is made of letters and no number. Precondition: not empty.
bool is_word(std::string_view token);

/// What the grammar allows at a place.
enum class Expected : std::uint8_t {
  root,              ///< the one value of the text
  value,             ///< behind ':' or ','
  value_or_bracket,  ///< behind '['
  name_or_brace,     ///< behind '{'
  name,              ///< behind ',' in an object
  colon,             ///< behind a member's name
  comma_or_brace,    ///< behind a member
  comma_or_bracket,  ///< behind an element
  end,               ///< behind the root value
};

/// Something stands at `at` that is not `expected`. Typical mistakes are called by their name.
ParseError explain_unexpected(std::string_view text, std::uint32_t at, Expected expected);

/// What begins at `at` looks like a number, but is none.
ParseError explain_number(std::string_view text, std::uint32_t at);

/// A string that begins at `quote` cannot go on at `at`: a bad escape, a control character or the
/// end of the text.
ParseError explain_string(std::string_view text, std::uint32_t quote, std::uint32_t at);

/// The text is not UTF-8. Precondition: it is not.
ParseError explain_invalid_utf8(std::string_view text);

}  // namespace gltfx::json
