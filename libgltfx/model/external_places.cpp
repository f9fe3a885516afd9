// SPDX-License-Identifier: Apache-2.0
#include "model/external_places.hpp"

#include <set>

#include "model/asset_obstacle.hpp"
#include "model/external_assets.hpp"
#include "model/fields.hpp"
#include "schema/version.hpp"

namespace gltfx::model {
namespace {

std::uint64_t count_external_assets(const json::Document& document) {
  if (document.empty() || !document.is_object(document.root())) return 0;
  const json::NodeId array = document.find(document.root(), "externalAssets");
  if (array == json::kNoNode || document.kind(array) != json::Kind::array) return 0;
  return schema::stated_version(document) > schema::kVersion2 ? document.array_size(array) : 0;
}

}  // namespace

bool has_external_assets(const json::Document& document) {
  return count_external_assets(document) > 0;
}

std::vector<ExternalPlace> external_places(const json::Document& document, const Views& views) {
  std::vector<ExternalPlace> places;
  const std::uint64_t count = count_external_assets(document);
  if (count == 0) return places;
  for (NodeIndex node = 0; node < views.nodes.size(); ++node) {
    if (views.nodes[node].object == json::kNoNode) continue;
    const auto index = unsigned_member(document, views.nodes[node].object, "externalAsset");
    if (index && *index < count) places.push_back({node, static_cast<std::uint32_t>(*index)});
  }
  return places;
}

SceneRoots attached_roots(const Asset& asset, const Views& views) {
  const json::Document& document = asset.document();
  const auto scene = unsigned_member(document, document.root(), "scene");
  const auto& scenes = asset.elements(RootArray::scenes);
  if (!scene || *scene >= scenes.size() || scenes[*scene] == json::kNoNode) return {};
  return choose_scene(asset, views, static_cast<std::uint32_t>(*scene));
}

void for_each_external_asset(const OpenedAsset& root,
                             const std::function<void(const OpenedAsset&)>& use) {
  if (!has_external_assets(root.document())) return;
  ExternalAssets assets(root);
  std::vector<AssetInTree*> open{&assets.root()};
  std::set<const AssetInTree*> seen{&assets.root()};
  for (std::size_t next = 0; next < open.size(); ++next) {
    AssetInTree& parent = *open[next];
    for (std::uint32_t i = 0; i < parent.external_assets().size(); ++i) {
      const auto file = parent.file_of(i);
      if (!file) continue;
      const auto& child = assets.asset(parent, *file);
      if (!child || !seen.insert(*child).second) continue;
      if (find_obstacle_of_child((*child)->asset())) continue;
      use((*child)->asset());
      open.push_back(*child);
    }
  }
}

}  // namespace gltfx::model
