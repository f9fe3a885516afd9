// SPDX-License-Identifier: Apache-2.0
/// Pages of schema/measures/ as data.
#pragma once

#include <gltfx/measure.hpp>

#include <string>
#include <string_view>

#include "schema/compiler/rule_page.hpp"

namespace gltfx::schema {

/// The content of a page. Texts are paragraphs without line breaks.
struct MeasurePage {
  std::string name;  ///< name of the file without `.md`
  std::uint16_t on = 0;
  MeasureType type = MeasureType::number;
  MeasureTotal total = MeasureTotal::none;
  MeasureNeeds needs = MeasureNeeds::json;
  std::string unit;
  std::string by;  ///< the function that takes it
  std::string summary, definition, help;
  std::string example, values;

  /// "BUDGET_OPEN_EDGES".
  std::string code() const;
  /// The rule about limits on the measure.
  RulePage rule() const;
};

/// Reads a page. `mistake`: empty, or "line: mistake" with the expectation.
MeasurePage read_measure_page(std::string name, std::string_view text, std::string& mistake);

}  // namespace gltfx::schema
