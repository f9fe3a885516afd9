// SPDX-License-Identifier: Apache-2.0
/// The detail of textures that a picture of a whole scene shows.
#pragma once

#include <cstdint>
#include <vector>

#include "render/scene.hpp"

namespace gltfx {

/// Texels of an image.
struct ImageSize {
  std::uint32_t width = 0, height = 0;  ///< 0: unknown
};

/// For each texture of a scene, how often both sides of its image can be halved so that two texels
/// at least stay for each pixel of a picture. `images`: by texture; `pixel`: length of the side of
/// a pixel where the scene is, in its unit. 0 where nothing is known.
std::vector<std::uint32_t> find_halvings(const render::Scene& scene,
                                         const std::vector<ImageSize>& images, double pixel);

}  // namespace gltfx
