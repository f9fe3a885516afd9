// SPDX-License-Identifier: Apache-2.0
/// Converts configurations of the Khronos validator and of its asset auditor to gltfx.toml.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace gltfx::tool {

struct ImportedConfig {
  std::string toml;
  std::vector<std::string> notes;  ///< what was left out, and why
};

/// Reads the YAML of the Khronos validator: `max-issues` (a number), `ignore` and `only` (lists of
/// codes), `override` (codes with 0 to 3). Lists and maps are on separate lines or in brackets; any
/// other YAML is an Error that names its line. `name` is that of the file.
Result<ImportedConfig> khronos_config_as_toml(std::string_view text, const std::string& name);

/// Whether a text is a JSON object and no YAML of blocks.
bool looks_like_json(std::string_view text);

/// Reads the JSON of the Khronos glTF Asset Auditor, which has `version` and a group of limits.
Result<ImportedConfig> auditor_config_as_toml(std::string_view text, const std::string& name);

}  // namespace gltfx::tool
