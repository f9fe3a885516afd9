// SPDX-License-Identifier: Apache-2.0
/// Writes GLBs, right ones and wrong ones, byte by byte.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "container/container.hpp"

namespace gltfx::container::test {

inline std::string little_endian(std::uint32_t value) {
  std::string bytes;
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes += static_cast<char>((value >> shift) & 0xFFU);
  }
  return bytes;
}

/// A chunk; `length` is that of its header, by default the true one.
inline std::string chunk(std::uint32_t type, std::string_view data,
                         std::optional<std::uint32_t> length = {}) {
  return little_endian(length.value_or(static_cast<std::uint32_t>(data.size()))) +
         little_endian(type) + std::string(data);
}

inline constexpr std::uint32_t kChunkOther = 0x4C594C41;  // "ALYL"
inline constexpr std::uint32_t kGlbMagic = 0x46546C67;
/// 28 bytes, so that its chunk needs no padding.
inline constexpr std::string_view kJson = R"({"asset":{"version":"2.0"}} )";

inline std::string json_chunk() { return chunk(kChunkJson, kJson); }
inline std::string bin_chunk(std::string_view data = "abcd") { return chunk(kChunkBin, data); }

/// Header fields that differ from the true values.
struct GlbHeader {
  std::optional<std::uint32_t> length = {};
  std::uint32_t version = 2;
  std::uint32_t magic = kGlbMagic;
};

inline std::string glb(std::string_view chunks, const GlbHeader& header = {}) {
  const auto length = static_cast<std::uint32_t>(12 + chunks.size());
  return little_endian(header.magic) + little_endian(header.version) +
         little_endian(header.length.value_or(length)) + std::string(chunks);
}

/// Opens `bytes` as a file named model.glb would be.
inline Container open_glb(std::string bytes) {
  return open_bytes(Bytes::from_string(std::move(bytes)), "model.glb");
}

}  // namespace gltfx::container::test
