// SPDX-License-Identifier: Apache-2.0
/// The configuration that applies, and its values by path.
///
/// It is searched from the working folder upwards, or named: never in the folder of an asset, which
/// could disable its own checks. A file may extend presets and other files, whose values come
/// before its own. The command line overrides a file, and a later override an earlier one.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "config_file.hpp"
#include "option_rows.hpp"

namespace gltfx::tool {

inline constexpr const char* kConfigName = "gltfx.toml";

/// One of the files of a configuration.
struct ConfigSource {
  std::string shown;   ///< its path from the working folder; empty: a preset
  std::string folder;  ///< absolute
  ConfigFile content;
};

/// A value that applies, and why.
struct Holding {
  const ConfigValue* value = nullptr;
  const ConfigOverride* because = nullptr;  ///< null: it applies to all paths
  const ConfigSource* source = nullptr;
};

class Configuration {
 public:
  /// The named configuration, else the nearest, with what it extends; an empty one when there is
  /// none. The Error describes the mistakes in a file. The pages of rules that they name are added
  /// to `pages`.
  static Result<Configuration> load(const ConfigChoice& choice,
                                    const std::shared_ptr<OwnPages>& pages);

  /// The path from the working folder; empty: there is none.
  std::string file() const { return sources_.empty() ? std::string() : sources_.back().shown; }
  /// The files and presets that it extends, in the order in which their values apply.
  const std::vector<std::string>& bases() const { return bases_; }
  bool has_overrides() const;

  /// Positions of the overrides that apply to a path of the working folder.
  std::vector<std::size_t> overrides_for(const std::string& path) const;
  /// The values of a key with these overrides: only the last one for keys with one value, and for
  /// lists that replace each other all values of the last place.
  std::vector<Holding> holding(const ConfigKey& key,
                               const std::vector<std::size_t>& overrides) const;

  /// The limits of the files with these overrides.
  std::vector<Limit> limits(const std::vector<std::size_t>& overrides) const;

  /// Adds values of the files to the words of options: all values of keys that add up, others only
  /// without an option on the command line. Limits are those of the files: words change them.
  void fill(Options& options, const std::vector<std::size_t>& overrides) const;

 private:
  class Loader;

  /// A part of a file, and the override that it is.
  struct Part {
    const ConfigSource* source = nullptr;
    const ConfigPart* part = nullptr;
    const ConfigOverride* because = nullptr;
  };
  /// What applies with these overrides: all files, then the overrides of all.
  std::vector<Part> parts(const std::vector<std::size_t>& overrides) const;
  Words words_of(const ConfigKey& key, const std::vector<std::size_t>& overrides) const;

  std::vector<ConfigSource> sources_;  ///< what is extended before what extends it
  std::vector<std::string> bases_;
};

/// Options of a validation by path.
class PathOptions {
 public:
  /// `options`: those of the command line.
  PathOptions(const Options& options, Configuration configuration);

  /// Two paths with equal results have the same options.
  std::vector<std::size_t> kind_of(const std::string& path) const {
    return configuration_.overrides_for(path);
  }
  /// Changes the options that differ by path.
  void apply(const std::vector<std::size_t>& kind, ValidateOptions& options) const;

 private:
  std::map<std::string, Words, std::less<>> given_;  ///< by name of the option
  std::shared_ptr<const OwnPages> own_pages_;
  Configuration configuration_;
};

/// The values of --config and --isolated.
ConfigChoice config_choice(const Options& options);

/// Fills the words of a verb from the configuration, if the verb has keys. The Error describes the
/// mistakes in the file.
std::optional<Error> configure(Options& options);

}  // namespace gltfx::tool
