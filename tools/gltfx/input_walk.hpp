// SPDX-License-Identifier: Apache-2.0
/// The inputs that the user named, one after the other.
#pragma once

#include <gltfx/searched_folders.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "base/hash.hpp"
#include "folder_walk.hpp"
#include "options.hpp"

namespace gltfx::tool {

struct Input {
  std::string path;            ///< "-" is standard input
  std::string place;           ///< below the named folder; of a file named itself, its name
  std::uint64_t position = 0;  ///< among the inputs of all shards
  bool ours = true;            ///< belongs to this run's shard
  bool unmatched = false;      ///< a glob without a match
};

/// Number of inputs that are given to the threads together: enough to keep them busy with little
/// memory.
inline constexpr std::size_t kBatch = 1024;

/// Arguments, then the lines of a list, which are not patterns.
class WordList {
 public:
  /// `named` outlives the list.
  explicit WordList(const NamedPaths& named)
      : named_(named), between_(named.listed.find('\0') != std::string::npos ? '\0' : '\n') {}

  std::optional<std::string> next();
  /// Whether next() gave a line of the list.
  bool from_list() const { return listed_ > 0; }

 private:
  const NamedPaths& named_;
  std::size_t word_ = 0;    ///< next of the arguments
  std::size_t listed_ = 0;  ///< start of the next line of the list
  char between_;            ///< lines of the list
};

/// Goes through words, lists and folders in the order of reports: that of the arguments, by bytes
/// of the path within a folder or glob. A path that does not exist is an input as well: opening it
/// gives the reason. So is a glob without a match, unless NamedPaths::allow_empty.
/// NamedPaths::exclude skips files in folders and in results of globs.
class InputWalk {
 public:
  /// `named` outlives the walk.
  explicit InputWalk(const NamedPaths& named);

  /// The next input of this run's shard, each once; nothing at the end.
  std::optional<Input> next();
  /// The same with those of other shards.
  std::optional<Input> next_of_all();

  /// Known at the end: folders among the arguments and the results of globs, whether there may be
  /// more than one file, and the folders and globs without any asset, as named.
  const std::vector<std::string>& folders() const { return folders_; }
  /// The folders searched so far: those among the arguments, and those in which globs begin to
  /// match. Grows.
  std::shared_ptr<const SearchedFolders> searched() const { return folder_.searched(); }
  bool several() const { return several_ || met_ > 1; }
  const std::vector<std::string>& without_assets() const { return without_assets_; }
  /// Number of assets that .gitignore files exclude, without those in excluded folders.
  std::uint64_t ignored() const { return folder_.ignored(); }

 private:
  std::optional<Input> step();
  void finish_word();
  std::optional<Input> enter(const std::string& path);
  std::optional<Input> take(std::string path, std::string place, const std::string& key);

  const NamedPaths& named_;
  WordList words_;
  FolderWalk folder_;
  std::vector<std::string> matches_;  ///< of a glob, the last one is next
  std::string current_;               ///< the word that is being expanded
  bool found_any_ = true;             ///< by that word
  bool may_repeat_;
  struct HashOfHash {
    std::size_t operator()(const Hash128& hash) const { return static_cast<std::size_t>(hash.low); }
  };
  std::unordered_set<Hash128, HashOfHash> seen_;
  std::uint64_t met_ = 0;
  std::vector<std::string> folders_, without_assets_;
  bool several_ = false;
};

}  // namespace gltfx::tool
