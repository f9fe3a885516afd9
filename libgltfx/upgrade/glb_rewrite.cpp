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

std::size_t padded(std::size_t size) { return (size + kAlignment - 1) / kAlignment * kAlignment; }

void append_chunk(std::string& out, std::uint32_t type, std::string_view data, char filler) {
  append_little_endian(out, padded(data.size()));
  append_little_endian(out, type);
  out += data;
  out.append(padded(data.size()) - data.size(), filler);
}

std::string changed(std::string_view bin, const BinChange& change) {
  std::string data;
  std::size_t at = 0;
  for (const ByteRange& range : change.cut) {
    data += bin.substr(at, range.begin - at);
    at = range.end;
  }
  data += bin.substr(at);
  return data += change.more;
}

/// What follows the JSON chunk: the BIN chunk's data, and all before and behind that chunk.
struct Rest {
  std::string_view before, bin, behind;
};

Rest rest_of(const container::Container& container, bool bin_changes) {
  const container::Chunk& chunk = container.chunks.front();
  const std::size_t begin = chunk.offset + chunk.length;
  const std::string_view old = container.bytes.text();
  if (!bin_changes || !container.bin) return {{}, {}, old.substr(begin)};
  const container::Chunk& bin = *container.bin;
  return {old.substr(begin, bin.header_offset - begin), old.substr(bin.offset, bin.length),
          old.substr(bin.offset + bin.length)};
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

Result<std::string> rewrite_glb(const container::Container& container, std::string_view json,
                                const BinChange& change) {
  const Rest rest = rest_of(container, !change.empty());
  const std::string bin = changed(rest.bin, change);
  json = without_padding(json);
  const std::uint64_t added = change.empty() ? 0 : kChunkHeader + std::uint64_t{padded(bin.size())};
  // What lies behind the last chunk is none of the asset and not counted.
  const std::size_t end = container.chunks.back().offset + container.chunks.back().length;
  const std::size_t uncounted = container.bytes.size() - end;
  const std::uint64_t total = kHeader + kChunkHeader + std::uint64_t{padded(json.size())} +
                              rest.before.size() + added + rest.behind.size() - uncounted;
  if (total > UINT32_MAX) return Error{"the new file would be longer than a GLB can be (4 GiB)"};
  std::string bytes(container.bytes.text().substr(0, kHeader - 4));  // magic and version
  bytes.reserve(total + uncounted);
  append_little_endian(bytes, total);
  append_chunk(bytes, container::kChunkJson, json, ' ');
  bytes += rest.before;
  if (!change.empty()) append_chunk(bytes, container::kChunkBin, bin, '\0');
  bytes += rest.behind;
  return bytes;
}

}  // namespace gltfx::upgrade
