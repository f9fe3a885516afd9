// SPDX-License-Identifier: Apache-2.0
/// Writes GLBs of version 3, right ones and wrong ones, byte by byte.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "container/glb_builder.hpp"

namespace gltfx::container::test {

/// A chunk; `length` is that of its header, by default the true one.
struct Chunk3 {
  std::uint32_t type = kChunkJson;
  std::string data;
  std::uint32_t encoding = 0;
  std::optional<std::uint64_t> length = {};
};

inline std::string little_endian_64(std::uint64_t value) {
  return little_endian(static_cast<std::uint32_t>(value)) +
         little_endian(static_cast<std::uint32_t>(value >> 32U));
}

inline std::string header_of(const Chunk3& chunk) {
  return little_endian(chunk.type) + little_endian(chunk.encoding) +
         little_endian_64(chunk.length.value_or(chunk.data.size()));
}

/// Chunks at multiples of 8 with `blank` between them; the file ends with the last chunk.
inline std::string glb3(const std::vector<Chunk3>& chunks, std::optional<std::uint64_t> length = {},
                        char blank = '\0') {
  std::string body;
  for (const Chunk3& chunk : chunks) {
    body.resize((body.size() + 7) / 8 * 8, blank);
    body += header_of(chunk) + chunk.data;
  }
  return little_endian(kGlbMagic) + little_endian(3) +
         little_endian_64(length.value_or(16 + body.size())) + body;
}

}  // namespace gltfx::container::test
