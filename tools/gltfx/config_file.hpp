// SPDX-License-Identifier: Apache-2.0
/// gltfx.toml as it was written, each value with its line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "command_table.hpp"

namespace gltfx::tool {

/// One value, as the command line would take it: "strict", "2048", "UNUSED_OBJECT=info".
struct ConfigValue {
  ConfigKey key;
  std::string word;
  std::uint32_t line = 0;
};

/// One [[overrides]]: what holds for some paths only.
struct ConfigOverride {
  std::vector<std::string> paths;  ///< patterns
  std::uint32_t line = 0;
  std::vector<ConfigValue> values;
};

struct ConfigFile {
  std::vector<ConfigValue> values;  ///< in the order of the lines
  std::vector<ConfigOverride> overrides;
};

/// Reads the text of a configuration. Every value is one that the command line would take. The
/// Error has a line for each mistake: "NAME:3: what is wrong".
Result<ConfigFile> parse_config(std::string_view text, const std::string& name);

}  // namespace gltfx::tool
