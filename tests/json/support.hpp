// SPDX-License-Identifier: Apache-2.0
/// What the tests of the JSON module share.
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

inline std::string_view fault_name(Fault fault) {
  constexpr std::array<std::string_view, 16> kNames{
      "syntax",        "unexpected_end", "invalid_utf8",    "control_character",
      "bad_escape",    "bad_number",     "bad_literal",     "too_deep",
      "too_large",     "trailing_data",  "byte_order_mark", "trailing_comma",
      "missing_comma", "duplicate_key",  "lone_surrogate",  "number_out_of_range"};
  return kNames[static_cast<std::size_t>(fault)];
}

/// "trailing_comma 1:5-1:6": a fault with line and column of both ends.
inline std::string show(const LineIndex& lines, const ParseFault& fault) {
  const Location at = lines.locate(fault.span);
  return fmt::format("{} {}:{}-{}:{}", fault_name(fault.fault), at.line, at.column, at.end_line,
                     at.end_column);
}

inline std::vector<std::string> faults_of(std::string_view text, const Limits& limits = {}) {
  const Parsed parsed = parse(text, limits);
  const LineIndex lines(text);
  std::vector<std::string> shown;
  for (const ParseFault& fault : parsed.faults) shown.push_back(show(lines, fault));
  return shown;
}

/// The document of a text that must have no fault.
inline Document parse_clean(std::string_view text) {
  Parsed parsed = parse(text);
  EXPECT_TRUE(parsed.ok()) << text << ": " << parsed.faults.front().detail;
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
