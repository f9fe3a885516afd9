// SPDX-License-Identifier: Apache-2.0
#include "upgrade/glb_rewrite.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace gltfx::upgrade {
namespace {

constexpr std::size_t kHeader = 12;
constexpr std::size_t kChunkHeader = 8;
constexpr std::size_t kAlignment = 4;

void append_little_endian(std::string& out, std::uint64_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8) {
    out += static_cast<char>((value >> shift) & 0xFFU);
  }
}

// The blanks that filled the old chunk up; new ones are counted anew.
std::string_view without_padding(std::string_view json) {
  for (std::size_t i = 1; i < kAlignment && json.ends_with(' '); ++i) json.remove_suffix(1);
  return json;
}

// What keeps nobody from finding the chunks: wrong lengths are counted anew, the rest is kept.
constexpr std::array<std::string_view, 9> kHarmless{
    "GLB_CHUNK_LENGTH_UNALIGNED", "GLB_CHUNK_TOO_BIG",        "GLB_DUPLICATE_CHUNK",
    "GLB_EMPTY_BIN_CHUNK",        "GLB_EXTRA_DATA",           "GLB_LENGTH_MISMATCH",
    "GLB_LENGTH_TOO_SMALL",       "GLB_UNEXPECTED_BIN_CHUNK", "GLB_UNKNOWN_CHUNK_TYPE"};

bool is_harmless(const container::ContainerFault& fault) {
  return std::find(kHarmless.begin(), kHarmless.end(), fault.code) != kHarmless.end();
}

}  // namespace

std::optional<std::string> find_glb_obstacle(const container::Container& container) {
  for (const auto* faults : {&container.faults, &container.late_faults}) {
    for (const container::ContainerFault& fault : *faults) {
      if (container.cut_short || !is_harmless(fault)) return fault.message;
    }
  }
  return std::nullopt;
}

Result<std::string> rewrite_glb(const container::Container& container, std::string_view json) {
  const std::string_view old = container.bytes.text();
  const container::Chunk& chunk = container.chunks.front();
  const std::string_view rest = old.substr(chunk.offset + chunk.length);
  // What lies behind the last chunk is none of the asset and not counted.
  const std::uint64_t end = container.chunks.back().offset + container.chunks.back().length;
  json = without_padding(json);
  const std::size_t padded = (json.size() + kAlignment - 1) / kAlignment * kAlignment;
  const std::uint64_t total =
      kHeader + kChunkHeader + std::uint64_t{padded} + (end - chunk.offset - chunk.length);
  if (total > UINT32_MAX) return Error{"the new file would be longer than a GLB can be (4 GiB)"};
  std::string bytes(old.substr(0, kHeader - 4));  // magic and version
  bytes.reserve(total + (old.size() - end));
  append_little_endian(bytes, total);
  append_little_endian(bytes, padded);
  append_little_endian(bytes, container::kChunkJson);
  bytes += json;
  bytes.append(padded - json.size(), ' ');
  bytes += rest;
  return bytes;
}

}  // namespace gltfx::upgrade
