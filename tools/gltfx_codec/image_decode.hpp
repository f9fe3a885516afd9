// SPDX-License-Identifier: Apache-2.0
/// What the decoders of images share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "codec/server.hpp"

namespace gltfx::codec {

/// That there are more texels than asked for.
Fault too_many_texels();

/// That a decoder which needs `bytes` of memory would not get them, or nothing: libraries in C do
/// not tell that memory has run out from bytes that are wrong.
bool exceeds_memory(const Job& job, std::uint64_t texels, std::uint64_t bytes_per_texel);
Fault no_memory();

/// Room for the pixels of `image` where they were asked for, else none. Throws std::bad_alloc.
std::span<std::byte> create_pixels(const Image& image, const Job& job, Output& output);

/// WebP, with libwebp itself: OpenImageIO 2.4 multiplies alpha into its colours whatever it is
/// told.
Answer decode_webp(const Job& job, std::span<const std::byte> bytes, Output& output);

}  // namespace gltfx::codec
