// SPDX-License-Identifier: Apache-2.0
/// Options of the command line and keys of gltfx.toml as plain data: manual pages and completions
/// are made from it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx::tool {

/// Words to choose from. Long sets have a name, under which scripts store them once.
struct WordSet {
  std::string name = {};  ///< "codes"; may be empty
  std::vector<std::string> words = {};
};

/// What completion offers for one option, or for the positional arguments of a verb.
struct Values {
  WordSet words = {};
  bool commas = false;       ///< several words separated by commas
  WordSet behind = {};       ///< words allowed after a word and "="
  bool file_behind = false;  ///< a file is allowed there
  bool files = false, folders = false;
  std::vector<std::string> endings = {};  ///< of files, without the dot; empty: all

  bool paths() const { return files || folders; }
};

/// How gltfx.toml writes a value.
enum class ConfigForm : std::uint8_t {
  word,      ///< "strict"
  number,    ///< 2048
  flag,      ///< true
  path,      ///< "../textures", from the folder of the file
  codes,     ///< ["UNUSED_OBJECT"]
  names,     ///< ["three@0.187"]
  patterns,  ///< ["old/", "*.draft.gltf"]
  files,     ///< ["ACME_leaf.schema.json"]: those of a list of paths that are not folders
  folders,   ///< ["schemas"]: those of the same list that are folders
  paths,     ///< ["house"]: files and folders
  levels,    ///< a table: UNUSED_OBJECT = "info"
  limits,    ///< tables of limits: ConfigPart::limits has them
};

/// The key of gltfx.toml for an option.
struct ConfigKey {
  std::string_view name = {};  ///< "profile"; empty: there is none
  ConfigForm form = ConfigForm::word;
  int place = 0;                    ///< keys are listed in this order
  std::string_view otherwise = {};  ///< the default
  bool by_path = false;             ///< allowed in [[overrides]]
  bool adds_up = false;  ///< values of several places add up; otherwise the last one counts
};

/// One option. Texts are literals.
struct OptionEntry {
  std::string_view short_name;     ///< "-f", or empty
  std::string_view name;           ///< "--format"
  std::string_view type;           ///< of its value: "NAME[=FILE]"; empty: it takes none
  std::string_view text;           ///< no full stop
  bool repeatable = false;         ///< each use adds to the previous ones
  std::function<Values()> values;  ///< null: no completion, as for numbers
  ConfigKey key;

  bool takes_value() const { return !type.empty(); }
  /// Whether the value may be left out: "[BOUNDS]". Then only a word with '=' that is no path
  /// follows as the value.
  bool is_value_optional() const { return type.starts_with('[') && type.ends_with(']'); }
  Values offered() const { return values ? values() : Values(); }
};

struct CommandEntry {
  std::string name;  ///< of the verb; empty: the program itself
  std::string text;
  OptionEntry positional;  ///< "PATH" and its meaning; no name: the verb takes options only
  std::vector<OptionEntry> options;
};

/// The program first, then its verbs, in the order of the help.
std::vector<CommandEntry> command_table();

/// An option that has a key in gltfx.toml, and the first verb that takes it.
struct KeyedOption {
  std::string_view verb;
  OptionEntry option;
};

/// One for each key, in the order in which keys are listed.
std::vector<KeyedOption> keyed_options();

}  // namespace gltfx::tool
