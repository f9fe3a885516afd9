// SPDX-License-Identifier: Apache-2.0
/// Makes images smaller by what their texels are.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "codec/client.hpp"

namespace gltfx::codec {

/// Texels that own their bytes.
struct Texels {
  Raster raster;
  std::vector<std::byte> bytes;
};

/// Texels of the same bits and channels, in a size that `how` allows, with as much of the aspect as
/// whole texels have. Precondition: how.needed(). Throws std::bad_alloc.
Texels resize(const Raster& raster, std::span<const std::byte> texels, const Resize& how);

}  // namespace gltfx::codec
