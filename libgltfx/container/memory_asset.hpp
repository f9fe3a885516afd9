// SPDX-License-Identifier: Apache-2.0
/// Assets in memory, as users hand them over, opened like those in files.
#pragma once

#include <gltfx/memory_asset.hpp>

#include <string>

#include "container/container.hpp"
#include "container/resolver.hpp"

namespace gltfx::container {

/// The bytes of the asset itself.
Container open_memory(std::string bytes, const std::string& name, AssetFormat format);

/// Of what it refers to. `root`: where files are looked up that do not come with it; empty:
/// nowhere.
Resolver resolver_of(const MemoryAsset& asset, const std::string& root);

}  // namespace gltfx::container
