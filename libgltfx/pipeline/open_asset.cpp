// SPDX-License-Identifier: Apache-2.0
#include "pipeline/open_asset.hpp"

#include <string_view>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>

#include "base/text.hpp"
#include "container/memory_asset.hpp"

namespace gltfx {
namespace {

constexpr std::size_t kShownPath = 200;

// The folder in which `path` was found, the widest one; null when it was named.
const std::string* folder_of_search(const std::string& path, const SearchedFolders& searched) {
  for (std::size_t end = path.starts_with('/') ? 1 : 0; end < path.size(); ++end) {
    if (end > 0 && path[end] != '/' && path[end - 1] != '/') continue;
    const auto folder = searched.find(std::string_view(path).substr(0, end));
    if (folder == searched.end()) continue;
    const bool goes_up = ("/" + path.substr(end) + "/").find("/../") != std::string::npos;
    if (!goes_up) return &*folder;
  }
  return nullptr;
}

Error outside(const std::string& path, const std::string& folder, std::string_view help) {
  const std::string name = folder.empty() ? std::string("the working folder")
                                          : "the folder " + quoted(folder, kShownPath);
  return {fmt::format("{} is outside {}; {}.", quoted(path, kShownPath), name, help)};
}

}  // namespace

Result<container::File> open_asset_file(const std::string& path, const AssetBounds& bounds) {
  const auto is_outside = [](const container::File& file) {
    return file.error == container::ResolveError::outside_root;
  };
  if (!bounds.root.empty()) {
    container::File file = container::open_within(bounds.root, path);
    if (!is_outside(file)) return file;
    return outside(path, bounds.root, "set a common parent folder with --root");
  }
  const std::string* folder = bounds.searched ? folder_of_search(path, *bounds.searched) : nullptr;
  if (folder == nullptr) return container::open_regular(AT_FDCWD, path.c_str());
  container::File file = container::open_within(*folder, path);
  if (!is_outside(file)) return file;
  return outside(path, *folder,
                 "name the file to which the link leads, or set a common parent folder with "
                 "--root");
}

Result<model::OpenedAsset> open_asset(const std::string& path, const AssetBounds& bounds) {
  const auto file = open_asset_file(path, bounds);
  if (!file) return file.error();
  auto container = container::open_file(*file, path);
  if (!container) return container.error();
  return model::OpenedAsset(path, *std::move(container),
                            resolver_for(std::filesystem::path(path).parent_path(), bounds.root));
}

Result<model::OpenedAsset> open_memory(MemoryAsset asset, const std::string& root) {
  if (!root.empty()) return Error{"an asset in memory has no folder: root is for files"};
  const std::string name = asset.name;
  container::Container opened = container::open_memory(std::move(asset.bytes), name, asset.format);
  return model::OpenedAsset(name, std::move(opened), container::resolver_of(std::move(asset), {}));
}

Result<model::OpenedAsset> open_document(const std::string& path, const AssetBounds& bounds) {
  auto asset = open_asset(path, bounds);
  if (!asset) return asset;
  if (auto obstacle = find_obstacle(*asset)) return *std::move(obstacle);
  return asset;
}

}  // namespace gltfx
