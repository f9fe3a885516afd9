// SPDX-License-Identifier: Apache-2.0
/// Two units that include all public headers, one in the order of their names, one backwards.
#pragma once

#include <gltfx/memory_asset.hpp>

namespace gltfx::test {

MemoryAsset make_asset_forward();
MemoryAsset make_asset_backward();
bool is_whole_forward(const MemoryAsset& asset);
bool is_whole_backward(const MemoryAsset& asset);

}  // namespace gltfx::test
