// SPDX-License-Identifier: Apache-2.0
/// What gltfx.toml may say: one table for reading, `gltfx config` and the command line's words.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "raw_options.hpp"

namespace gltfx::tool {

/// How a value is written.
enum class ConfigForm : std::uint8_t {
  word,    ///< "strict"
  number,  ///< 2048
  flag,    ///< true
  path,    ///< "../textures", from the folder of the file
  codes,   ///< ["UNUSED_OBJECT"]
  names,   ///< ["three@0.187"]
  paths,   ///< ["ACME_leaf.schema.json", "schemas"]
  levels,  ///< a table: UNUSED_OBJECT = "info"
};

/// Where the values of a list or table come from when several places have some.
enum class ConfigMerge : std::uint8_t { last, all };

struct ConfigKey {
  std::string_view name;  ///< with its table: "budgets.triangles"
  ConfigForm form;
  ConfigMerge merge;
  bool by_path;                ///< allowed in [[overrides]]
  std::string_view otherwise;  ///< the default
  // None where another verb alone has use for it.
  std::string RawValidateOptions::*word = nullptr;                ///< where a single value goes
  std::vector<std::string> RawValidateOptions::*words = nullptr;  ///< where several go
};

/// In the order in which they are shown.
std::span<const ConfigKey> config_keys();

/// The key with that name, or null.
const ConfigKey* find_config_key(std::string_view name);

}  // namespace gltfx::tool
