// SPDX-License-Identifier: Apache-2.0
#include "image_decode.hpp"

#include <new>

#include "base/checked.hpp"

namespace gltfx::codec {

Fault too_many_texels() { return {FaultKind::too_large, "It has more texels than are decoded."}; }

bool exceeds_memory(const Job& job, std::uint64_t texels, std::uint64_t bytes_per_texel) {
  const auto size = checked_mul(texels, bytes_per_texel);
  return !size || *size > job.memory_bytes;
}

Fault no_memory() { return {FaultKind::out_of_memory, "Decoding takes more memory than it may."}; }

std::span<std::byte> create_pixels(const Image& image, const Job& job, Output& output) {
  if (!job.pixels) return {};
  const auto size = result_size(image);
  if (!size || *size > job.memory_bytes) throw std::bad_alloc();
  const std::span<std::byte> pixels = output.create(*size);
  if (pixels.size() < *size) throw std::bad_alloc();
  return pixels;
}

}  // namespace gltfx::codec
