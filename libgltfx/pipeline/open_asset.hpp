// SPDX-License-Identifier: Apache-2.0
/// How every verb opens a file, and where its references may lead.
#pragma once

#include <gltfx/memory_asset.hpp>
#include <gltfx/searched_folders.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "base/result.hpp"
#include "container/resolver.hpp"
#include "model/asset_obstacle.hpp"
#include "model/opened_asset.hpp"

namespace gltfx {

/// Where an asset may lie, and its resources: members of that name as in ValidateOptions.
struct AssetBounds {
  std::string root;
  std::shared_ptr<const SearchedFolders> searched;

  template <class Options>
  static AssetBounds of(const Options& options) {
    return {options.root, options.searched};
  }
};

/// The file of the asset. The Error says why there is none, `bounds` included.
Result<container::File> open_asset_file(const std::string& path, const AssetBounds& bounds);

/// Opens, reads nothing of it yet.
Result<model::OpenedAsset> open_asset(const std::string& path, const AssetBounds& bounds);

/// The same for an asset in memory, for verbs that read no file: an Error where `root` names a
/// folder.
Result<model::OpenedAsset> open_memory(MemoryAsset asset, const std::string& root);

/// Opens, and refuses what has a model::find_obstacle().
Result<model::OpenedAsset> open_document(const std::string& path, const AssetBounds& bounds);

/// The asset's folder is the base of its references; the root of trust is that folder or a wider
/// one that the user named.
inline container::Resolver resolver_for(const std::filesystem::path& folder,
                                        const std::string& root) {
  const std::filesystem::path base = folder.empty() ? std::filesystem::path(".") : folder;
  return {root.empty() ? base : std::filesystem::path(root), base};
}

}  // namespace gltfx
