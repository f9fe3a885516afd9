// SPDX-License-Identifier: Apache-2.0
/// The contents of gltfx.toml, each value with its line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "command_table.hpp"
#include "measure/limit.hpp"

namespace gltfx::tool {

/// One value in the form of the command line: "strict", "2048", "UNUSED_OBJECT=info".
struct ConfigValue {
  ConfigKey key;
  std::string word;
  std::uint32_t line = 0;
};

/// A table of values, for all paths or some.
struct ConfigPart {
  std::vector<ConfigValue> values;  ///< in the order of the lines
  std::vector<measure::LimitChange> limits;
};

/// One [[overrides]]: values for some paths only.
struct ConfigOverride : ConfigPart {
  std::vector<std::string> paths;  ///< patterns
  std::uint32_t line = 0;
};

/// A preset or file that a configuration extends.
struct ConfigBase {
  std::string name;
  std::uint32_t line = 0;
};

struct ConfigFile : ConfigPart {
  std::vector<ConfigBase> extends;
  std::vector<ConfigOverride> overrides;
};

/// Reads the text of a configuration. Every value is valid on the command line. The Error has a
/// line for each mistake: "NAME:3: mistake".
Result<ConfigFile> parse_config(std::string_view text, const std::string& name);

}  // namespace gltfx::tool
