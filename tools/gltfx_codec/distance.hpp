// SPDX-License-Identifier: Apache-2.0
/// Measures the difference between an image and its source.
#pragma once

#include "codec/image_distance.hpp"
#include "resize.hpp"

namespace gltfx::codec {

/// Of normal maps with the angle. Precondition: both have the same size, at least one texel, and 8
/// or 16 bits per channel.
ImageDistance distance(const Texels& one, const Texels& other, TexelKind kind);

}  // namespace gltfx::codec
