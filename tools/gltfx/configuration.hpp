// SPDX-License-Identifier: Apache-2.0
/// Which configuration holds, and for which path what.
///
/// It is looked for from the working folder upwards, or named: never in the folder of an asset,
/// which could switch off its own checks. What the command line says stands before what a file
/// says, and a later override before an earlier one.
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

/// A value that holds, and why.
struct Holding {
  const ConfigValue* value = nullptr;
  const ConfigOverride* because = nullptr;  ///< null: it holds for all paths
};

class Configuration {
 public:
  /// The one that the words name, else the nearest; an empty one when there is none. The Error says
  /// what is wrong with the file.
  static Result<Configuration> load(const ConfigChoice& choice);

  /// From the working folder; empty: there is none.
  const std::string& file() const { return shown_; }
  bool has_overrides() const { return !content_.overrides.empty(); }

  /// Positions of the overrides that hold for a path of the working folder.
  std::vector<std::size_t> overrides_for(const std::string& path) const;
  /// What holds for a key where these overrides do: the last one alone for keys that take one
  /// value, and for lists that replace each other all of the last place that has one.
  std::vector<Holding> holding(const ConfigKey& key,
                               const std::vector<std::size_t>& overrides) const;

  /// Adds what the file says to the words of options: all of it where keys add up, else where the
  /// command line says nothing.
  void fill(Options& options, const std::vector<std::size_t>& overrides) const;

 private:
  /// A path that the file names, from the working folder.
  std::string path_from_file(const std::string& path) const;
  Words words_of(const ConfigKey& key, const std::vector<std::size_t>& overrides) const;

  std::string shown_;
  std::string folder_;  ///< absolute
  ConfigFile content_;
};

/// What validation is asked for, path by path.
class PathOptions {
 public:
  /// `options`: what the command line says.
  PathOptions(const Options& options, Configuration configuration);

  /// Two paths with equal results have the same options.
  std::vector<std::size_t> kind_of(const std::string& path) const {
    return configuration_.overrides_for(path);
  }
  /// Changes what differs by path.
  void apply(const std::vector<std::size_t>& kind, ValidateOptions& options) const;

 private:
  std::map<std::string, Words, std::less<>> given_;  ///< by name of the option
  Configuration configuration_;
};

/// What --config and --isolated say.
ConfigChoice config_choice(const Options& options);

/// Fills the words of a verb from the configuration that holds, if it has keys. The Error says what
/// is wrong with the file.
std::optional<Error> configure(Options& options);

}  // namespace gltfx::tool
