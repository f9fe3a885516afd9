// SPDX-License-Identifier: Apache-2.0
/// Encodes Draco meshes with Google's library.
#pragma once

#include <cstddef>
#include <span>

#include "codec/decode.hpp"

namespace gltfx::codec {

/// Encodes the mesh in a payload of codec/draco_source.hpp without quantisation. Edgebreaker with
/// the speeds 0 and 5: the shorter of the two, for each is on some meshes.
Answer encode_draco(std::span<const std::byte> payload, const Output& output);

}  // namespace gltfx::codec
