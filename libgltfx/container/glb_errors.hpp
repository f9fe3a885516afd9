// SPDX-License-Identifier: Apache-2.0
/// The words for each error of a GLB. One function a code; the code is in the error.
#pragma once

#include <cstdint>
#include <string_view>

#include "container/container.hpp"

namespace gltfx::container::glb_error {

/// `found`: what the file is instead, or empty.
ContainerError invalid_magic(std::uint32_t magic, std::string_view found);
ContainerError invalid_version(std::uint32_t version);
ContainerError length_too_small(std::uint32_t declared);
ContainerError length_mismatch(std::uint32_t declared, std::uint64_t actual);
ContainerError end_of_header(std::uint64_t actual);
ContainerError extra_data(std::uint32_t declared, std::uint64_t actual);
ContainerError end_of_chunk_header(std::uint64_t header_offset, std::uint64_t actual);
ContainerError end_of_chunk_data(const Chunk& chunk, std::uint32_t declared, std::uint64_t actual);
ContainerError too_many_chunks(std::uint64_t offset, std::uint64_t actual);

/// `length` is what the chunk's header says.
ContainerError chunk_unaligned(const Chunk& chunk, std::uint32_t length);
ContainerError chunk_too_big(const Chunk& chunk, std::uint32_t length, std::uint32_t declared);
ContainerError unexpected_first(const Chunk& chunk);
ContainerError unexpected_bin(const Chunk& chunk, std::size_t position);
ContainerError empty_json(const Chunk& chunk);
ContainerError empty_bin(const Chunk& chunk);
ContainerError duplicate(const Chunk& chunk);
ContainerError unknown_type(const Chunk& chunk);

}  // namespace gltfx::container::glb_error
