// SPDX-License-Identifier: Apache-2.0
#include "pipeline/external_needs.hpp"

#include <set>

#include "model/external_places.hpp"

namespace gltfx {

std::vector<std::string> external_assets_where(
    const model::OpenedAsset& asset, const std::function<bool(const model::OpenedAsset&)>& wanted) {
  std::set<std::string> names;
  model::for_each_external_asset(asset, [&](const model::OpenedAsset& child) {
    if (!names.contains(child.name()) && wanted(child)) names.insert(child.name());
  });
  return {names.begin(), names.end()};
}

}  // namespace gltfx
