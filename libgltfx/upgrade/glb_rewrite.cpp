// SPDX-License-Identifier: Apache-2.0
#include "upgrade/glb_rewrite.hpp"

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

}  // namespace

Result<std::string> rewrite_glb(const container::Container& container, std::string_view json) {
  const std::string_view old = container.bytes.text();
  const container::Chunk& chunk = container.chunks.front();
  const std::string_view rest = old.substr(chunk.offset + chunk.length);
  json = without_padding(json);
  const std::size_t padded = (json.size() + kAlignment - 1) / kAlignment * kAlignment;
  const std::uint64_t total = kHeader + kChunkHeader + std::uint64_t{padded} + rest.size();
  if (total > UINT32_MAX) return Error{"the new file would be longer than a GLB can be (4 GiB)"};
  std::string bytes(old.substr(0, kHeader - 4));  // magic and version
  bytes.reserve(total);
  append_little_endian(bytes, total);
  append_little_endian(bytes, padded);
  append_little_endian(bytes, container::kChunkJson);
  bytes += json;
  bytes.append(padded - json.size(), ' ');
  bytes += rest;
  return bytes;
}

}  // namespace gltfx::upgrade
