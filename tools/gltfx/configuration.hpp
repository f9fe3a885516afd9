// SPDX-License-Identifier: Apache-2.0
/// Which configuration holds, and for which path what.
///
/// It is looked for from the working folder upwards, or named: never in the folder of an asset,
/// which could switch off its own checks. What the command line says stands before what a file
/// says, and a later override before an earlier one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "config_file.hpp"
#include "raw_options.hpp"

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

  /// The words with what the file says where they say nothing.
  RawValidateOptions apply(RawValidateOptions words,
                           const std::vector<std::size_t>& overrides) const;
  void apply(RawEditOptions& words) const;
  void apply(RawUpgradeOptions& words) const;
  void apply(RawFixOptions& words) const;
  void apply(RawBakeOptions& words) const;
  void apply(RawInspectOptions& words) const;
  void apply(RawSchemaOptions& words) const;

 private:
  /// A path that the file names, from the working folder.
  std::string path_from_file(const std::string& path) const;
  /// A word that holds for all paths, where the command line says nothing.
  void fill(std::string_view key, std::string& word) const;
  std::vector<std::string> words_of(const ConfigKey& key,
                                    const std::vector<std::size_t>& overrides) const;
  void add_excludes(std::vector<std::string>& exclude) const;
  void add_schemas(std::vector<std::string>& files, std::vector<std::string>& folders) const;

  std::string shown_;
  std::string folder_;  ///< absolute
  ConfigFile content_;
};

/// What validation is asked for, path by path.
class PathOptions {
 public:
  PathOptions(RawValidateOptions words, Configuration configuration)
      : words_(std::move(words)), configuration_(std::move(configuration)) {}

  /// Two paths with equal results have the same options.
  std::vector<std::size_t> kind_of(const std::string& path) const {
    return configuration_.overrides_for(path);
  }
  /// Changes what differs by path.
  void apply(const std::vector<std::size_t>& kind, ValidateOptions& options) const;

 private:
  RawValidateOptions words_;
  Configuration configuration_;
};

/// request_of() the words with the configuration that holds.
Result<ValidateRequest> configured(const RawValidateOptions& words);
Result<PageRequest> configured(const RawPageOptions& words);
Result<UpgradeRequest> configured(RawUpgradeOptions words);
Result<FixRequest> configured(RawFixOptions words);
Result<DeleteRequest> configured(RawDeleteOptions words);
Result<BakeRequest> configured(RawBakeOptions words);
Result<InspectRequest> configured(RawInspectOptions words);
Result<SchemaRequest> configured(RawSchemaOptions words);

}  // namespace gltfx::tool
