// SPDX-License-Identifier: Apache-2.0
/// Limits as rows of text.
#pragma once

#include <gltfx/limit.hpp>

#include <string>
#include <vector>

namespace gltfx::tool {

/// A setting as a row of `gltfx config`.
struct ConfigRow {
  std::string name;   ///< "budgets.mesh.triangles"; empty: that of the row above
  std::string value;  ///< "max 1,000 (warning)"
  std::string why;    ///< where the value is from
};

ConfigRow limit_row(const Limit& limit, std::string why);

/// A line for each row, in columns.
std::string in_columns(const std::vector<ConfigRow>& rows);

}  // namespace gltfx::tool
