// SPDX-License-Identifier: Apache-2.0
/// The message for each error of a GLB. One function per code; the code is in the error.
#pragma once

#include <cstdint>

#include "container/container.hpp"
#include "container/content.hpp"

namespace gltfx::container {

/// Damage to a GLB by a program that treats it as text.
enum class TextDamage : std::uint8_t {
  none,
  line_ends,  ///< "\n" became "\r\n"
  replaced,   ///< bytes that are not UTF-8 became U+FFFD
  encoded,    ///< each byte became a character of UTF-8
};

}  // namespace gltfx::container

namespace gltfx::container::glb_error {

/// `found`: the actual format of the file, if known.
ContainerError invalid_magic(std::uint32_t magic, const Content& found);
ContainerError invalid_version(std::uint32_t version);
ContainerError length_too_small(std::uint64_t declared);
ContainerError length_mismatch(std::uint64_t declared, std::uint64_t actual);
/// `takes`: bytes of such a header.
ContainerError end_of_header(std::uint64_t actual, std::uint64_t takes);
ContainerError extra_data(std::uint64_t declared, std::uint64_t actual);
ContainerError end_of_chunk_header(std::uint64_t header_offset, std::uint64_t actual,
                                   std::uint64_t takes);
ContainerError end_of_chunk_data(const Chunk& chunk, std::uint64_t declared, std::uint64_t actual);
ContainerError too_many_chunks(std::uint64_t offset, std::uint64_t actual, std::size_t most);

/// `length` is that of the chunk's header.
ContainerError chunk_unaligned(const Chunk& chunk, std::uint64_t length);
ContainerError chunk_too_big(const Chunk& chunk, std::uint64_t length, std::uint64_t declared);
ContainerError unexpected_first(const Chunk& chunk);
ContainerError unexpected_bin(const Chunk& chunk, std::size_t position);
ContainerError empty_json(const Chunk& chunk);
ContainerError empty_bin(const Chunk& chunk);
ContainerError duplicate(const Chunk& chunk);
ContainerError unknown_type(const Chunk& chunk);

// Of version 3:
ContainerError layout_of_version_2();
ContainerError no_json(std::uint64_t offset);
/// A BIN chunk before the JSON.
ContainerError bin_before_json(const Chunk& chunk);
ContainerError unknown_encoding(const Chunk& chunk);
ContainerError long_json(const Chunk& chunk);
/// A byte between two chunks, which is not 0.
ContainerError gap(std::uint64_t offset, unsigned char byte);

/// The meaning of a chunk type of 0 or 1.
ContainerError numbered_type(const Chunk& chunk);
/// `length` does not include the padding in the file.
ContainerError uncounted_padding(const Chunk& chunk, std::uint64_t length);
ContainerError changed_as_text(TextDamage damage);

}  // namespace gltfx::container::glb_error
