// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "codec/decode.hpp"

namespace gltfx::codec {

/// Decodes AVIF to RGB or RGBA, with 16 bits if there are more than 8; the first frame of an
/// animation. Rotation, mirroring and cropping for display are not applied.
Answer decode_avif(const Job& job, std::span<const std::byte> bytes, const Output& output);

}  // namespace gltfx::codec
