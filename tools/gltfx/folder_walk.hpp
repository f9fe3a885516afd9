// SPDX-License-Identifier: Apache-2.0
/// The assets below a folder that the user named, without what .gitignore files leave out.
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
/// settings of a repository that nobody vouches for could make it start programs.
class IgnoreFiles {
 public:
  /// The walk begins in `folder`. Files above it count as far as the top of its repository; outside
  /// of repositories there are none.
  void begin(const std::string& folder);
  /// The walk goes into a folder, or back out of it; `folder` ends in '/'.
  void enter(const std::string& folder);
  void leave();
  /// `path` lies directly in the folder that was entered last.
  bool ignores(std::string_view path, bool is_folder) const;

 private:
  struct Pattern {
    std::string text;
    bool keep = false;          ///< begins with '!'
    bool folders_only = false;  ///< ends in '/'
    bool anchored = false;      ///< fits paths from the folder of its file only
  };
  struct File {
    std::string before;    ///< what paths of the walk lack: from the file's folder to its start
    std::size_t skip = 0;  ///< bytes of a walked path that lie above the file's folder
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
/// that are symbolic links are entered only when named, `.git` never. Leaves out what .gitignore
/// files name, or NamedPaths::exclude. Holds the names of the folders that it is in, so that memory
/// does not grow with the number of files.
class FolderWalk {
 public:
  /// `named` outlives the walk.
  explicit FolderWalk(const NamedPaths& named);

  /// Begins with a folder. False when it cannot be listed. Precondition: at_end().
  bool enter(const std::string& folder);
  bool at_end() const { return open_.empty(); }
  /// The next one, or nothing: then the walk is at its end, or has to be asked again.
  std::optional<FoundFile> next();
  /// `folder`, as paths of what is found begin, is searched by other means.
  void note_search(const std::string& folder) { searched_->insert(folder); }
  /// What was searched so far. Grows.
  std::shared_ptr<const SearchedFolders> searched() const { return searched_; }
  /// Whether NamedPaths::exclude names a file or folder.
  bool is_excluded(std::string_view path, std::string_view place) const;
  /// Assets that .gitignore files name, those in folders that they name left out.
  std::uint64_t ignored() const { return ignored_; }

 private:
  // What is left to visit of one folder: names that end in NUL, those of folders with '/' before.
  struct Listing {
    std::string path;  ///< ends in '/'
    std::string names;
    std::vector<std::uint32_t> order;  ///< where names begin; the last one is next
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
