// SPDX-License-Identifier: Apache-2.0
/// The assets below a named folder, except those that .gitignore files exclude.
#pragma once

#include <gltfx/searched_folders.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options.hpp"

namespace gltfx::tool {

/// The .gitignore files along a walk through folders, read as gitignore(5) describes them. The
/// user's own lists (core.excludesFile, .git/info/exclude) are not read, and git is not run: the
/// settings of an untrusted repository could make it start programs.
class IgnoreFiles {
 public:
  /// The walk begins in `folder`. Files in parent folders up to the top of its repository count;
  /// outside of repositories there are none.
  void begin(const std::string& folder);
  /// Enters a folder, or leaves it; `folder` ends in '/'.
  void enter(const std::string& folder);
  void leave();
  /// `path` is directly in the folder that was entered last.
  bool ignores(std::string_view path, bool is_folder) const;

 private:
  struct Pattern {
    std::string text;
    bool keep = false;          ///< begins with '!'
    bool folders_only = false;  ///< ends in '/'
    bool anchored = false;      ///< matches paths from the folder of its file only
  };
  struct File {
    std::string before;    ///< path from the file's folder to the start of the walk
    std::size_t skip = 0;  ///< bytes of a walked path above the file's folder
    std::vector<Pattern> patterns;
  };

  void read(const std::string& folder, std::string before, std::size_t skip);
  static std::vector<Pattern> parse(std::string_view text);

  std::vector<File> files_;  ///< from the top of the repository to the folder entered last
  bool in_repository_ = false;
};

/// An asset below a folder.
struct FoundFile {
  std::string path;
  std::string place;  ///< below the folder that was named
};

/// Walks one folder after the other for assets, in the order of the bytes of their paths. Folders
/// that are symbolic links are entered only when named, `.git` never. Skips matches of .gitignore
/// files and of NamedPaths::exclude. Keeps only the names of the open folders, so that memory does
/// not grow with the number of files.
class FolderWalk {
 public:
  /// `named` outlives the walk.
  explicit FolderWalk(const NamedPaths& named);

  /// Begins with a folder. False when it cannot be listed. Precondition: at_end().
  bool enter(const std::string& folder);
  bool at_end() const { return open_.empty(); }
  /// The next asset, or nothing: then the walk is at its end, or must be called again.
  std::optional<FoundFile> next();
  /// Records that `folder`, the beginning of found paths, is searched by other means.
  void note_search(const std::string& folder) { searched_->insert(folder); }
  /// The folders searched so far. Grows.
  std::shared_ptr<const SearchedFolders> searched() const { return searched_; }
  /// Whether NamedPaths::exclude names a file or folder.
  bool is_excluded(std::string_view path, std::string_view place) const;
  /// Number of assets that .gitignore files exclude, without those in excluded folders.
  std::uint64_t ignored() const { return ignored_; }

 private:
  // The remaining entries of one folder: names that end in NUL, those of folders with '/' before
  // it.
  struct Listing {
    std::string path;  ///< ends in '/'
    std::string names;
    std::vector<std::uint32_t> order;  ///< starts of names; the last one is next
  };

  bool list(const std::string& folder);
  bool is_left_out(const std::string& path, bool is_folder);

  const NamedPaths& named_;
  std::string working_folder_;
  std::size_t root_length_ = 0;  ///< of the path of the folder that was named
  std::vector<Listing> open_;    ///< from the folder that was named to that of the next file
  IgnoreFiles ignore_files_;     ///< along open_
  std::uint64_t ignored_ = 0;
  std::shared_ptr<SearchedFolders> searched_ = std::make_shared<SearchedFolders>();
};

/// Whether a path ends in .gltf, .glb or .vrm (an avatar in a GLB), in any case of letters.
bool is_asset_name(const std::string& path);

}  // namespace gltfx::tool
