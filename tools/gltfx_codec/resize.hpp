// SPDX-License-Identifier: Apache-2.0
/// Makes images smaller, depending on the meaning of their texels.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "codec/client.hpp"

namespace gltfx::codec {

/// Texels with their memory.
struct Texels {
  Raster raster;
  std::vector<std::byte> bytes;
};

/// Texels with the same bits and channels, in a size within the limit of `how`, with the aspect
/// ratio rounded to whole texels. Precondition: how.needed(). Throws std::bad_alloc.
Texels resize(const Raster& raster, std::span<const std::byte> texels, const Resize& how);

}  // namespace gltfx::codec
