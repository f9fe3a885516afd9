// SPDX-License-Identifier: Apache-2.0
/// Encodes Draco meshes with Google's library.
#pragma once

#include <cstddef>
#include <span>

#include "codec/decode.hpp"

namespace gltfx::codec {

/// Encodes the mesh in a payload of codec/draco_source.hpp without quantisation. Tries edgebreaker
/// with the speeds 0 and 5 and returns the shorter result, because it depends on the mesh.
Answer encode_draco(std::span<const std::byte> payload, const Output& output);

}  // namespace gltfx::codec
