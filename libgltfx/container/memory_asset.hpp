// SPDX-License-Identifier: Apache-2.0
/// Assets in memory, opened like those in files.
#pragma once

#include <gltfx/memory_asset.hpp>

#include <string>

#include "container/container.hpp"
#include "container/resolver.hpp"

namespace gltfx::container {

/// The bytes of the asset itself.
Container open_memory(std::string bytes, const std::string& name, AssetFormat format);

/// A resolver of the asset's resources. `root`: the folder of files that the asset does not
/// include; empty: none. Moves `files` out of the asset, and nothing else.
Resolver resolver_of(MemoryAsset&& asset, const std::string& root);

}  // namespace gltfx::container
