// SPDX-License-Identifier: Apache-2.0
/// Changes the size of images, depending on the meaning of their texels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/client.hpp"

namespace gltfx::codec {

/// Texels with their memory.
struct Texels {
  Raster raster;
  std::vector<std::byte> bytes;
};

struct Size {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  bool operator==(const Size&) const = default;
};

/// A size within the limit of `how`, with the aspect ratio rounded to whole texels.
Size limited_size(const Raster& raster, const Resize& how);

/// Texels with the same bits and channels in another size, which may be larger. Ignores
/// how.max_side. Throws std::bad_alloc.
Texels resize(const Raster& raster, std::span<const std::byte> texels, const Size& size,
              const Resize& how);

}  // namespace gltfx::codec
