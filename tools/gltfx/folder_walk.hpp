// SPDX-License-Identifier: Apache-2.0
/// The assets below a folder that the user named.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ignore_files.hpp"
#include "options.hpp"

namespace gltfx::tool {

/// An asset below a folder.
struct FoundFile {
  std::string path;
  std::string place;  ///< below the folder that was named
};

/// Walks one folder after the other for .gltf and .glb files (in any case of letters), in the order
/// of the bytes of their paths. Folders that are symbolic links are entered only when named, `.git`
/// never. Leaves out what .gitignore files name, or NamedPaths::exclude. Holds the names of the
/// folders that it is in, so that memory does not grow with the number of files.
class FolderWalk {
 public:
  /// `named` outlives the walk.
  explicit FolderWalk(const NamedPaths& named);

  /// Begins with a folder. False when it cannot be listed. Precondition: at_end().
  bool enter(const std::string& folder);
  bool at_end() const { return open_.empty(); }
  /// The next one, or nothing: then the walk is at its end, or has to be asked again.
  std::optional<FoundFile> next();
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
};

/// Whether a path ends in .gltf or .glb, in any case of letters.
bool is_asset_name(const std::string& path);

}  // namespace gltfx::tool
