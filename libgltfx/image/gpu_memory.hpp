// SPDX-License-Identifier: Apache-2.0
/// Memory of images on a graphics card, with all mipmap levels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "image/header.hpp"
#include "image/ktx2.hpp"

namespace gltfx::image {

/// Bytes of an image that is decoded to four bytes a texel.
std::uint64_t gpu_bytes(const Header& header);

/// Bytes in the block format. Transcoded formats take one byte per texel, or half a byte for ETC1S
/// without alpha; all others are kept as stored.
std::uint64_t gpu_bytes(const Ktx2& file);

/// Of any file, by its header; 0 if that cannot be read.
std::uint64_t gpu_bytes(std::span<const std::byte> file);

}  // namespace gltfx::image
