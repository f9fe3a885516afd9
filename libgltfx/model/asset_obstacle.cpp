// SPDX-License-Identifier: Apache-2.0
#include "model/asset_obstacle.hpp"

#include <cstdint>

#include <fmt/format.h>

#include "base/text.hpp"
#include "model/fields.hpp"
#include "model/memory_budget.hpp"
#include "schema/version.hpp"

namespace gltfx::model {

std::optional<Error> find_obstacle(const OpenedAsset& asset) {
  if (asset.container().format == container::Format::git_lfs_pointer) {
    return Error{"it is a Git LFS pointer; run 'git lfs pull'"};
  }
  if (!asset.container().json) return Error{"it is not a glTF asset; see 'gltfx validate'"};
  const json::Document& document = asset.document();
  if (document.empty()) return Error{"its JSON is invalid; see 'gltfx validate'"};
  const std::uint64_t count = root_objects(document);
  const std::uint64_t most = most_root_objects(document.text().size());
  if (count <= most) return std::nullopt;
  return Error{
      fmt::format("its root arrays have {} elements; at most {} are allowed in {} bytes of JSON",
                  count, most, document.text().size())};
}

std::optional<Error> find_obstacle_of_child(const OpenedAsset& asset) {
  if (auto obstacle = find_obstacle(asset)) return obstacle;
  const json::Document& document = asset.document();
  if (!document.is_object(document.root())) {
    return Error{"it is not a glTF asset; see 'gltfx validate'"};
  }
  const json::NodeId header = object_member(document, document.root(), "asset");
  const std::string written = string_member(document, header, "version");
  const auto version = schema::parse_version(written);
  if (!version || version->major == schema::kVersion2.major) return std::nullopt;
  return Error{fmt::format("its version is {}, not glTF 2", quoted(written, 20))};
}

}  // namespace gltfx::model
