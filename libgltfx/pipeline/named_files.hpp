// SPDX-License-Identifier: Apache-2.0
/// Which assets name which files: those of a run, and those that lie beside them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "base/file_state.hpp"
#include "pipeline/open_asset.hpp"

namespace gltfx {

/// Files that an asset refers to, other than assets in `files` (glTF 2.1). Nothing is read but the
/// text of the asset.
struct NamedFiles {
  std::string path;                ///< of the asset
  FileIdentity own;                ///< of the asset
  std::set<FileIdentity> buffers;  ///< what a buffer is
  std::set<FileIdentity> files;    ///< all
  bool unread = false;             ///< the asset cannot be read, so that the sets are empty
  bool names(const std::set<FileIdentity>& wanted) const;
};

/// Positions of assets in a list, in order.
using InputGroup = std::vector<std::size_t>;

/// Assets that have to be changed together: they share a buffer, or one of them is read by another.
/// Each asset is in one group; groups are in the order of their first assets.
std::vector<InputGroup> groups_of(const std::vector<std::string>& paths, const AssetBounds& bounds,
                                  unsigned jobs);

/// The assets of folders, each folder looked at once. Any number of threads may call.
class FolderIndex {
 public:
  /// Assets in `folder` that refer to one of the files, as far as a bounded search tells.
  std::vector<std::string> naming(const std::filesystem::path& folder,
                                  const std::set<FileIdentity>& files);
  /// Why some of the assets in `folder` may be missing from the results of naming(), half a
  /// sentence; empty: none is.
  std::string find_gap(const std::filesystem::path& folder);
  /// One that refers to the asset at `path` as to a buffer or an image, from the same folder;
  /// empty: there is none.
  std::string reader_of(const std::string& path);

 private:
  struct Folder {
    std::vector<NamedFiles> assets;
    std::string gap;  ///< as find_gap()
  };
  const Folder& read(const std::filesystem::path& folder);
  static Folder assets_in(const std::filesystem::path& folder);

  std::mutex mutex_;
  std::map<std::filesystem::path, Folder> folders_;
};

}  // namespace gltfx
