// SPDX-License-Identifier: Apache-2.0
#include "pipeline/opened_asset.hpp"

#include <cstdint>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "model/limits.hpp"
#include "pipeline/resolver_for.hpp"

namespace gltfx {

std::optional<Error> find_text_obstacle(const container::Container& container) {
  if (container.format == container::Format::git_lfs_pointer) {
    return Error{"it is a Git LFS pointer; run 'git lfs pull'"};
  }
  if (!container.json) return Error{"it is not a glTF asset; see 'gltfx validate'"};
  return std::nullopt;
}

std::optional<Error> find_document_obstacle(const json::Parsed& parsed) {
  const json::Document& document = parsed.document;
  if (document.empty()) return Error{"its JSON is invalid; see 'gltfx validate'"};
  const std::uint64_t count = model::root_objects(document);
  const std::uint64_t most = model::most_root_objects(document.text().size());
  if (count <= most) return std::nullopt;
  return Error{
      fmt::format("its root arrays have {} elements; at most {} are allowed in {} bytes of JSON",
                  count, most, document.text().size())};
}

Result<OpenedAsset> open_asset(const std::string& path, const std::string& root) {
  auto opened = container::open_file(path);
  if (!opened) return opened.error();
  if (auto obstacle = find_text_obstacle(*opened)) return *std::move(obstacle);
  OpenedAsset asset;
  asset.resolver = resolver_for(std::filesystem::path(path).parent_path(), root);
  asset.parsed = json::parse(opened->json);
  asset.container = *std::move(opened);
  if (auto obstacle = find_document_obstacle(asset.parsed)) return *std::move(obstacle);
  return asset;
}

}  // namespace gltfx
