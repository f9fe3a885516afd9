// SPDX-License-Identifier: Apache-2.0
/// The configuration of the Khronos validator as one of ours.
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

/// Reads the YAML that the Khronos validator takes: `max-issues` (a number), `ignore` and `only`
/// (lists of codes), `override` (codes with 0 to 3). Lists and maps stand on lines of their own or
/// in brackets; anything else of YAML is an Error that names its line. `name` is that of the file.
Result<ImportedConfig> khronos_config_as_toml(std::string_view text, const std::string& name);

}  // namespace gltfx::tool
