// SPDX-License-Identifier: Apache-2.0
/// Converts a configuration of the Khronos validator to gltfx.toml.
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

}  // namespace gltfx::tool
