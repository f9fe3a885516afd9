// SPDX-License-Identifier: Apache-2.0
/// The project's own decoders of meshoptimizer's streams.
#pragma once

#include "model/meshopt.hpp"

namespace gltfx::model::meshopt {

/// Elements of a block of an attribute stream: a multiple of 16.
constexpr std::uint64_t block_elements(std::uint64_t stride) {
  const std::uint64_t fitting = 8192 / stride / 16 * 16;
  return fitting < 256 ? fitting : 256;
}

/// Bytes behind the blocks: the first element and, since version 1, the modes of its channels, all
/// of it padded to a least size.
constexpr std::uint64_t tail_size(std::uint64_t stride, unsigned version) {
  const std::uint64_t size = version == 0 ? stride : stride + stride / 4;
  const std::uint64_t least = version == 0 ? 32 : 24;
  return size < least ? least : size;
}

/// Attribute streams of both versions. Precondition of all three: check_size() has found nothing.
DecodeError decode_attributes(std::span<const std::byte> stream, const Layout& layout,
                              std::span<std::byte> elements);
DecodeError decode_triangles(std::span<const std::byte> stream, const Layout& layout,
                             std::span<std::byte> elements);
DecodeError decode_indices(std::span<const std::byte> stream, const Layout& layout,
                           std::span<std::byte> elements);

}  // namespace gltfx::model::meshopt
