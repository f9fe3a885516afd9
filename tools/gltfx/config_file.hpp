// SPDX-License-Identifier: Apache-2.0
/// The contents of gltfx.toml, each value with its line.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "command_table.hpp"
#include "measure/limit.hpp"
#include "own_pages.hpp"

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

/// A path that a configuration names, from the working folder.
using ResolvePath = std::function<std::string(const std::string& path)>;

/// Reads the text of a configuration. Every value is valid on the command line. The Error has a
/// line for each mistake: "NAME:3: mistake". The pages that it names are added to `pages`.
Result<ConfigFile> parse_config(std::string_view text, const std::string& name,
                                const ResolvePath& resolve, const std::shared_ptr<OwnPages>& pages);

}  // namespace gltfx::tool
