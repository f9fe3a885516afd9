// SPDX-License-Identifier: Apache-2.0
/// What stands at a place of a text that may be no JSON at all.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/span.hpp"

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

}  // namespace gltfx::json
