// SPDX-License-Identifier: Apache-2.0
/// Code shared by the tests of the JSON module.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "json/lines.hpp"
#include "json/parse.hpp"

namespace gltfx::json::testing {

inline std::string_view error_name(SyntaxError error) {
  constexpr std::array<std::string_view, 16> kNames{
      "syntax",        "unexpected_end", "invalid_utf8",    "control_character",
      "bad_escape",    "bad_number",     "bad_literal",     "too_deep",
      "too_large",     "trailing_data",  "byte_order_mark", "trailing_comma",
      "missing_comma", "duplicate_key",  "lone_surrogate",  "number_out_of_range"};
  return kNames[static_cast<std::size_t>(error)];
}

/// "trailing_comma 1:5-1:6": an error with line and column of both ends.
inline std::string show(const LineIndex& lines, const ParseError& error) {
  const Location at = lines.locate(error.span);
  return fmt::format("{} {}:{}-{}:{}", error_name(error.error), at.line, at.column, at.end_line,
                     at.end_column);
}

inline std::vector<std::string> errors_of(std::string_view text, const Limits& limits = {}) {
  const Parsed parsed = parse(text, limits);
  const LineIndex lines(text);
  std::vector<std::string> shown;
  for (const ParseError& error : parsed.errors) shown.push_back(show(lines, error));
  return shown;
}

/// The document of a text that must have no error.
inline Document parse_clean(std::string_view text) {
  Parsed parsed = parse(text);
  EXPECT_TRUE(parsed.ok()) << text << ": " << parsed.errors.front().detail;
  return std::move(parsed.document);
}

inline std::vector<double> numbers_of(const Document& document, NodeId array) {
  std::vector<double> values;
  for (NumberCursor at(document, array); at.valid(); at.advance()) {
    values.push_back(at.number().value);
  }
  return values;
}

/// A text that has a bit of everything.
inline constexpr std::string_view kSample = R"({
  "asset": {"version": "2.0", "generator": "a \"test\" \u00e9 \uD83D\uDE00 ünï"},
  "empty": [{}, [], ""],
  "numbers": [0, -1, 2.5, 1e3, -0.25E-2],
  "mixed": [1, "two", 3.5, null, [4, 5], {"six": 7}],
  "flags": {"yes": true, "no": false, "none": null}
})";

}  // namespace gltfx::json::testing
