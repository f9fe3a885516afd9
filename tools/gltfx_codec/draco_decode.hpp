// SPDX-License-Identifier: Apache-2.0
/// Decodes Draco meshes with Google's library.
#pragma once

#include <cstddef>
#include <span>

#include "codec/decode.hpp"

namespace gltfx::codec {

/// Decodes a Draco bitstream (version 2.2) with a triangle mesh.
Answer decode_draco(const Job& job, std::span<const std::byte> bytes, const Output& output);

}  // namespace gltfx::codec
