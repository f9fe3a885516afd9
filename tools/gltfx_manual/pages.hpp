// SPDX-License-Identifier: Apache-2.0
/// The output of the generator: one function per file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "command_table.hpp"

namespace gltfx::tool {

/// Date and version of the pages.
struct Edition {
  std::string date;  ///< "2026-11-22"
  std::string version;
};

/// gltfx(1) for the first entry of the table, gltfx-VERB(1) for the others.
std::string command_page(const std::vector<CommandEntry>& table, const CommandEntry& command,
                         const Edition& edition);
/// gltfx.toml(5).
std::string config_page(const Edition& edition);

std::string bash_completion(const std::vector<CommandEntry>& table);
std::string zsh_completion(const std::vector<CommandEntry>& table);
std::string fish_completion(const std::vector<CommandEntry>& table);

/// "gltfx" or "gltfx-upgrade".
std::string page_of(const CommandEntry& command);

}  // namespace gltfx::tool
