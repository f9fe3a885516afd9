// SPDX-License-Identifier: Apache-2.0
/// Pages of schema/measures/ as data.
#pragma once

#include <gltfx/measure.hpp>

#include <string>
#include <string_view>
#include <vector>

#include "schema/compiler/rule_page.hpp"

namespace gltfx::schema {

/// The content of a page. Texts are paragraphs without line breaks.
struct MeasurePage {
  std::string stem;  ///< name of the file without `.md`: "open-edges", "channels.image"
  std::uint16_t on = 0;
  MeasureScope first = MeasureScope::asset;  ///< of the list of scopes
  MeasureType type = MeasureType::number;
  MeasureTotal total = MeasureTotal::none;
  MeasureNeeds needs = MeasureNeeds::json;
  std::string unit;
  std::vector<std::string> by;  ///< the functions that take it
  std::string summary, definition, help;
  std::string example, values;

  /// The stem up to the point: measures of two types may have one name on different scopes.
  std::string name() const { return stem.substr(0, stem.find('.')); }
  /// "open_edges", "channels_image".
  std::string identifier() const;
  /// "BUDGET_OPEN_EDGES".
  std::string code() const;
  /// The rule about limits on the measure.
  RulePage rule() const;
};

/// Reads a page. `mistake`: empty, or "line: mistake" with the expectation.
MeasurePage read_measure_page(std::string stem, std::string_view text, std::string& mistake);

}  // namespace gltfx::schema
