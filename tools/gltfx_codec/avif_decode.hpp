// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "codec/decode.hpp"

namespace gltfx::codec {

/// Decodes AVIF to RGB or RGBA, of 16 bits where there are more than 8; of an animation the first
/// frame. Rotation, mirroring and cropping for display are not applied.
Answer decode_avif(const Job& job, std::span<const std::byte> bytes, const Output& output);

}  // namespace gltfx::codec
