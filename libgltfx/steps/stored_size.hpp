// SPDX-License-Identifier: Apache-2.0
/// The size of an asset with its files.
#pragma once

#include <cstdint>

#include "model/opened_asset.hpp"

namespace gltfx::steps {

/// The size of an asset in bytes, including all files that it refers to.
std::uint64_t stored_size(const model::OpenedAsset& asset);

}  // namespace gltfx::steps
