// SPDX-License-Identifier: Apache-2.0
#include "pipeline/open_asset.hpp"

#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "model/memory_budget.hpp"

namespace gltfx {

Result<model::OpenedAsset> open_asset(const std::string& path, const std::string& root) {
  auto container = container::open_file(path);
  if (!container) return container.error();
  return model::OpenedAsset(path, *std::move(container),
                            resolver_for(std::filesystem::path(path).parent_path(), root));
}

std::optional<Error> find_obstacle(const model::OpenedAsset& asset) {
  if (asset.container().format == container::Format::git_lfs_pointer) {
    return Error{"it is a Git LFS pointer; run 'git lfs pull'"};
  }
  if (!asset.container().json) return Error{"it is not a glTF asset; see 'gltfx validate'"};
  const json::Document& document = asset.document();
  if (document.empty()) return Error{"its JSON is invalid; see 'gltfx validate'"};
  const std::uint64_t count = model::root_objects(document);
  const std::uint64_t most = model::most_root_objects(document.text().size());
  if (count <= most) return std::nullopt;
  return Error{
      fmt::format("its root arrays have {} elements; at most {} are allowed in {} bytes of JSON",
                  count, most, document.text().size())};
}

Result<model::OpenedAsset> open_document(const std::string& path, const std::string& root) {
  auto asset = open_asset(path, root);
  if (!asset) return asset;
  if (auto obstacle = find_obstacle(*asset)) return *std::move(obstacle);
  return asset;
}

}  // namespace gltfx
