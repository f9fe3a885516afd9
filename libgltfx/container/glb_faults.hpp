// SPDX-License-Identifier: Apache-2.0
/// The words for each fault of a GLB. One function a code; the code is in the fault.
#pragma once

#include <cstdint>
#include <string_view>

#include "container/container.hpp"

namespace gltfx::container::glb_fault {

/// `found`: what the file is instead, or empty.
ContainerFault invalid_magic(std::uint32_t magic, std::string_view found);
ContainerFault invalid_version(std::uint32_t version);
ContainerFault length_too_small(std::uint32_t declared);
ContainerFault length_mismatch(std::uint32_t declared, std::uint64_t actual);
ContainerFault end_of_header(std::uint64_t actual);
ContainerFault extra_data(std::uint32_t declared, std::uint64_t actual);
ContainerFault end_of_chunk_header(std::uint64_t header_offset, std::uint64_t actual);
ContainerFault end_of_chunk_data(const Chunk& chunk, std::uint32_t declared, std::uint64_t actual);
ContainerFault too_many_chunks(std::uint64_t offset, std::uint64_t actual);

/// `length` is what the chunk's header says.
ContainerFault chunk_unaligned(const Chunk& chunk, std::uint32_t length);
ContainerFault chunk_too_big(const Chunk& chunk, std::uint32_t length, std::uint32_t declared);
ContainerFault unexpected_first(const Chunk& chunk);
ContainerFault unexpected_bin(const Chunk& chunk, std::size_t position);
ContainerFault empty_json(const Chunk& chunk);
ContainerFault empty_bin(const Chunk& chunk);
ContainerFault duplicate(const Chunk& chunk);
ContainerFault unknown_type(const Chunk& chunk);

}  // namespace gltfx::container::glb_fault
