// SPDX-License-Identifier: Apache-2.0
#include "pipeline/opened_asset.hpp"

#include <filesystem>
#include <utility>

#include "pipeline/resolver_for.hpp"

namespace gltfx {

Result<OpenedAsset> open_asset(const std::string& path, const std::string& root) {
  auto opened = container::open_file(path);
  if (!opened) return opened.error();
  if (opened->format == container::Format::git_lfs_pointer) {
    return Error{"it is a Git-LFS pointer; 'git lfs pull' fetches the file itself"};
  }
  if (!opened->json) return Error{"it holds no glTF; 'gltfx validate' says why"};
  OpenedAsset asset;
  asset.resolver = resolver_for(std::filesystem::path(path).parent_path(), root);
  asset.parsed = json::parse(opened->json);
  asset.container = *std::move(opened);
  if (!asset.parsed.document.empty()) return asset;
  return Error{"its JSON is broken; 'gltfx validate' says where"};
}

}  // namespace gltfx
