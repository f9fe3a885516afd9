// SPDX-License-Identifier: Apache-2.0
/// The inputs that the user named, one after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "base/hash.hpp"
#include "ignore_files.hpp"
#include "options.hpp"

namespace gltfx::tool {

struct Input {
  std::string path;            ///< "-" is standard input
  std::string place;           ///< below the folder that was named; of one named itself its name
  std::uint64_t position = 0;  ///< among the inputs of all shards
  bool ours = true;            ///< belongs to this run's shard
  bool unmatched = false;      ///< a glob that nothing matches
};

/// Inputs that are handed to the threads together: many enough to keep them busy, few enough for
/// little memory.
inline constexpr std::size_t kBatch = 1024;

/// Goes through words, lists and folders in the order of reports: that of the arguments, by bytes
/// of the path within a folder or glob. Holds the names of the folders it is in, so that memory
/// does not grow with the number of files. A path that does not exist is an input as well: opening
/// it says why. So is a glob that nothing matches, unless NamedPaths::allow_empty.
///
/// Folders are searched through for .gltf and .glb files (in any case of letters); folders that are
/// symbolic links are entered only when named, `.git` never. What .gitignore files name, or
/// NamedPaths::exclude, is left out of folders; exclude also of what globs give.
class InputWalk {
 public:
  /// `named` outlives the walk.
  explicit InputWalk(const NamedPaths& named);

  /// The next one that belongs to this run's shard, each once; nothing at the end.
  std::optional<Input> next();
  /// The same with those of other shards.
  std::optional<Input> next_of_all();

  /// Known at the end: folders among the arguments and what globs gave, whether more than one file
  /// may be meant, and the folders and globs without any asset, as they were named.
  const std::vector<std::string>& folders() const { return folders_; }
  bool several() const { return several_ || met_ > 1; }
  const std::vector<std::string>& without_assets() const { return without_assets_; }
  /// Assets that .gitignore files name, those in folders that they name left out.
  std::uint64_t ignored() const { return ignored_; }

 private:
  // What is left to visit of one folder: names that end in NUL, those of folders with '/' before.
  struct Listing {
    std::string path;  ///< ends in '/'
    std::string names;
    std::vector<std::uint32_t> order;  ///< where names begin; the last one is next
  };

  std::optional<Input> step();
  std::optional<Input> step_into_folders();
  std::optional<std::string> next_word();
  void finish_word();
  std::optional<Input> enter(const std::string& path);
  bool list(const std::string& folder);
  bool is_excluded(std::string_view path, std::string_view place) const;
  bool is_left_out(const std::string& path, bool is_folder);
  std::optional<Input> take(std::string path, std::string place, const std::string& key);

  const NamedPaths& named_;
  std::size_t word_ = 0;              ///< next of the arguments
  std::size_t listed_ = 0;            ///< where the next line of the list begins
  char between_;                      ///< lines of the list
  std::vector<std::string> matches_;  ///< of a glob, the last one is next
  std::vector<Listing> open_;         ///< from the folder that was named to that of the next file
  IgnoreFiles ignore_files_;          ///< along open_
  std::uint64_t ignored_ = 0;
  std::string here_;             ///< working folder
  std::size_t root_length_ = 0;  ///< of the path of the folder that was named
  std::string current_;          ///< the word that is being expanded
  bool found_any_ = true;        ///< by that word
  bool may_repeat_;
  struct HashOfHash {
    std::size_t operator()(const Hash128& hash) const { return static_cast<std::size_t>(hash.low); }
  };
  std::unordered_set<Hash128, HashOfHash> seen_;
  std::uint64_t met_ = 0;
  std::vector<std::string> folders_, without_assets_;
  bool several_ = false;
};

/// Whether a path ends in .gltf or .glb, in any case of letters.
bool is_asset_name(const std::string& path);

}  // namespace gltfx::tool
