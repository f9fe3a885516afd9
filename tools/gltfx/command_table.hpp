// SPDX-License-Identifier: Apache-2.0
/// What the command line takes, as plain data: what `--help` shows, manual pages and completions
/// are made from.
#pragma once

#include <string>
#include <vector>

namespace gltfx::tool {

/// One option.
struct OptionEntry {
  std::string short_name;   ///< "-f", or empty
  std::string name;         ///< "--format"
  std::string type;         ///< of its value: "NAME[=FILE]"; empty: it takes none
  std::string text;         ///< no full stop
  bool repeatable = false;  ///< each use adds to those before

  bool takes_value() const { return !type.empty(); }
};

struct CommandEntry {
  std::string name;  ///< of the verb; empty: the program itself
  std::string text;
  std::string positional;       ///< "PATH"; empty: the verb takes options alone
  std::string positional_text;  ///< what it stands for
  std::vector<OptionEntry> options;
};

/// The program first, then its verbs, in the order of the help.
std::vector<CommandEntry> command_table();

}  // namespace gltfx::tool
