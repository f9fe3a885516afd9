// SPDX-License-Identifier: Apache-2.0
/// JSON (RFC 8259) into a flat `Document`: one pass, iterative, every error with its place.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/shared_text.hpp"
#include "base/span.hpp"
#include "json/document.hpp"

namespace gltfx::json {

/// The errors of a JSON text.
enum class SyntaxError : std::uint8_t {
  // The text could not be read to its end: there is no document.
  syntax,             ///< something other than the grammar allows here
  unexpected_end,     ///< the text ends inside a value
  invalid_utf8,       ///< bytes that are not UTF-8
  control_character,  ///< a raw control character inside a string
  bad_escape,         ///< an escape JSON does not have
  bad_number,         ///< 01, +1, .5, 1., 0x10, NaN, Infinity
  bad_literal,        ///< True, None, undefined, single quotes, comments, unquoted keys
  too_deep,           ///< nested deeper than Limits::depth
  too_large,          ///< longer than Limits::bytes, at most what a span can address (4 GiB)
  trailing_data,      ///< something after the root value
  // Parsing continues: the document is complete, and the intended meaning is clear.
  byte_order_mark,      ///< U+FEFF before the text
  trailing_comma,       ///< before ']' or '}'
  missing_comma,        ///< two members or elements without one between them
  duplicate_key,        ///< the last one wins
  lone_surrogate,       ///< half of a UTF-16 pair, read as U+FFFD
  number_out_of_range,  ///< beyond a double, read as an infinity
};

/// Whether parsing continued after the error.
bool is_recoverable(SyntaxError error);

struct ParseError {
  SyntaxError error;
  Span span;           ///< bytes of the text to mark; never empty but at the end of the text
  std::string detail;  ///< what was found and expected, printable; may be empty
  Span other;          ///< duplicate_key: the key before; unclosed bracket: where it was opened
};

struct Limits {
  std::uint32_t depth = 1024;          ///< containers inside one another
  std::uint32_t recorded_errors = 64;  ///< recoverable errors kept; the others are only counted
  std::uint32_t bytes = UINT32_MAX;    ///< length of the text
};

struct Parsed {
  Document document;               ///< empty when an error was not recoverable
  std::vector<ParseError> errors;  ///< in the order of the text
  std::uint64_t unrecorded_errors = 0;
  bool ok() const { return errors.empty(); }
};

/// Parses `text`, which the document keeps. Time and memory are linear in its length.
Parsed parse(SharedText text, const Limits& limits = {});
/// Convenience for small texts: copies.
Parsed parse(std::string_view text, const Limits& limits = {});

}  // namespace gltfx::json
