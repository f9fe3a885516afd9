// SPDX-License-Identifier: Apache-2.0
/// From a place in the text to an error that says what stands there and what should.
#pragma once

#include <cstdint>
#include <string_view>

#include "json/parse.hpp"

namespace gltfx::json {

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
