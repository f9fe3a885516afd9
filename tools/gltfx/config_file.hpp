// SPDX-License-Identifier: Apache-2.0
/// The contents of gltfx.toml, each value with its line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "command_table.hpp"

namespace gltfx::tool {

/// One value in the form of the command line: "strict", "2048", "UNUSED_OBJECT=info".
struct ConfigValue {
  ConfigKey key;
  std::string word;
  std::uint32_t line = 0;
};

/// One [[overrides]]: values for some paths only.
struct ConfigOverride {
  std::vector<std::string> paths;  ///< patterns
  std::uint32_t line = 0;
  std::vector<ConfigValue> values;
};

struct ConfigFile {
  std::vector<ConfigValue> values;  ///< in the order of the lines
  std::vector<ConfigOverride> overrides;
};

/// Reads the text of a configuration. Every value is valid on the command line. The Error has a
/// line for each mistake: "NAME:3: mistake".
Result<ConfigFile> parse_config(std::string_view text, const std::string& name);

}  // namespace gltfx::tool
