// SPDX-License-Identifier: Apache-2.0
/// Where an asset has its external assets, and what they add there (glTF 2.1, "External assets").
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "model/asset.hpp"
#include "model/opened_asset.hpp"
#include "model/pose.hpp"

namespace gltfx::model {

/// Whether the asset has `externalAssets`. An asset of glTF 2.0 has none, whatever its members.
bool has_external_assets(const json::Document& document);

/// A node that has an external asset.
struct ExternalPlace {
  NodeIndex node = 0;
  std::uint32_t external_asset = 0;  ///< index of an element of the array
};
/// In the order of the nodes. None unless has_external_assets().
std::vector<ExternalPlace> external_places(const json::Document& document, const Views& views);

/// The roots that an external asset adds: those of its default scene. Without a default scene it
/// adds none, and the scene is absent.
SceneRoots attached_roots(const Asset& asset, const Views& views);

/// Calls `use` for each asset below this one, at any depth, that can be opened and has no obstacle,
/// once each.
void for_each_external_asset(const OpenedAsset& root,
                             const std::function<void(const OpenedAsset&)>& use);

}  // namespace gltfx::model
