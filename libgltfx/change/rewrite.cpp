// SPDX-License-Identifier: Apache-2.0
#include "change/rewrite.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "base/codes.hpp"
#include "container/bytes.hpp"

namespace gltfx::change {
namespace {

constexpr std::size_t kHeader = 12;
constexpr std::size_t kChunkHeader = 8;
constexpr std::size_t kAlignment = 4;

void append_little_endian(std::string& out, std::uint64_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8) {
    out += static_cast<char>((value >> shift) & 0xFFU);
  }
}

// Errors with which the chunks can still be found: wrong lengths are corrected, the rest is kept.
constexpr std::array<Code, 10> kHarmless{
    Code::GLB_CHUNK_LENGTH_UNALIGNED, Code::GLB_CHUNK_TOO_BIG,    Code::GLB_CHUNK_TYPE_NUMBER,
    Code::GLB_DUPLICATE_CHUNK,        Code::GLB_EMPTY_BIN_CHUNK,  Code::GLB_EXTRA_DATA,
    Code::GLB_LENGTH_MISMATCH,        Code::GLB_LENGTH_TOO_SMALL, Code::GLB_UNEXPECTED_BIN_CHUNK,
    Code::GLB_UNKNOWN_CHUNK_TYPE};

bool is_harmless(const container::ContainerError& error) {
  return std::find(kHarmless.begin(), kHarmless.end(), error.code) != kHarmless.end();
}

std::size_t padded(std::size_t size) { return (size + kAlignment - 1) / kAlignment * kAlignment; }

using container::Bytes;
using container::size_of;
using Pieces = std::vector<Bytes>;

std::string chunk_header(std::uint32_t type, std::uint64_t length) {
  std::string header;
  append_little_endian(header, length);
  append_little_endian(header, type);
  return header;
}

/// What follows the JSON chunk: the BIN chunk's data, and everything before and after that chunk.
struct Rest {
  Bytes before, bin, behind;
};

Rest rest_of(const container::Container& container, bool bin_changes) {
  const Bytes& old = container.bytes;
  const auto part = [&](std::size_t begin, std::size_t end) {
    return old.part(begin, end - begin);
  };
  const container::Chunk& chunk = container.chunks.front();
  const std::size_t begin = chunk.offset + chunk.length;
  if (!bin_changes || !container.bin) return {{}, {}, part(begin, old.size())};
  const container::Chunk& bin = *container.bin;
  const std::size_t end = bin.offset + bin.length;
  return {part(begin, bin.header_offset), part(bin.offset, end), part(end, old.size())};
}

Pieces changed_bin(const Bytes& bin, const BinChange& change) {
  if (change.whole) return *change.whole;
  Pieces data;
  std::size_t at = 0;
  auto patch = change.patches.begin();
  const auto keep_to = [&](std::size_t end) {
    for (; patch != change.patches.end() && patch->offset < end; ++patch) {
      data.push_back(bin.part(at, patch->offset - at));
      data.push_back(Bytes::from_string(patch->bytes));
      at = patch->offset + patch->bytes.size();
    }
    data.push_back(bin.part(at, end - at));
  };
  for (const ByteRange& range : change.cut) {
    keep_to(range.begin);
    at = range.end;
  }
  keep_to(bin.size());
  data.push_back(Bytes::from_string(change.more));
  return data;
}

}  // namespace

std::optional<std::string> find_glb_obstacle(const container::Container& container) {
  if (container.glb_version == 3U) return "gltfx reads GLBs of version 3, but does not write them";
  for (const auto* errors : {&container.errors, &container.late_errors}) {
    for (const container::ContainerError& error : *errors) {
      if (container.cut_short || !is_harmless(error)) return error.message;
    }
  }
  return std::nullopt;
}

// White space that is not all blanks stays longer than padding is: it would be taken for that.
std::string_view without_padding(std::string_view json) {
  const std::size_t end = json.find_last_not_of(" \t\r\n") + 1;
  const bool blank = json.find_first_not_of(' ', end) == std::string_view::npos;
  const std::size_t least = blank ? end : end + kAlignment;
  for (std::size_t i = 1; i < kAlignment && json.ends_with(' ') && json.size() > least; ++i) {
    json.remove_suffix(1);
  }
  return json;
}

Result<Pieces> rewrite_glb(const container::Container& container, std::string_view json,
                           const BinChange& change) {
  const Rest rest = rest_of(container, !change.empty());
  const Pieces bin = changed_bin(rest.bin, change);
  const std::size_t bin_size = size_of(bin);
  json = without_padding(json);
  const bool has_new = !change.empty() && !change.drop;
  const std::uint64_t added = has_new ? kChunkHeader + std::uint64_t{padded(bin_size)} : 0;
  // Bytes after the last chunk are not part of the asset and not counted.
  const std::size_t end = container.chunks.back().offset + container.chunks.back().length;
  const std::size_t uncounted = container.bytes.size() - end;
  const std::uint64_t total = kHeader + kChunkHeader + std::uint64_t{padded(json.size())} +
                              rest.before.size() + added + rest.behind.size() - uncounted;
  if (total > UINT32_MAX) return Error{"the new file exceeds the maximum size of a GLB (4 GiB)"};
  std::string head(container.bytes.text().substr(0, kHeader - 4));  // magic and version
  append_little_endian(head, total);
  head += chunk_header(container::kChunkJson, padded(json.size()));
  head.append(json).append(padded(json.size()) - json.size(), ' ');
  Pieces pieces{Bytes::from_string(std::move(head)), rest.before};
  if (has_new) {
    pieces.push_back(Bytes::from_string(chunk_header(container::kChunkBin, padded(bin_size))));
    pieces.insert(pieces.end(), bin.begin(), bin.end());
    pieces.push_back(Bytes::from_string(std::string(padded(bin_size) - bin_size, '\0')));
  }
  pieces.push_back(rest.behind);
  return pieces;
}

Result<Pieces> rewrite_sound(const container::Container& container, std::string_view json,
                             const BinChange& bin) {
  json = without_padding(json);
  std::vector<std::pair<std::uint32_t, Pieces>> chunks;
  chunks.push_back({container::kChunkJson, {Bytes::from_string(std::string(json))}});
  for (const container::Chunk& chunk : std::span(container.chunks).subspan(1)) {
    const Bytes data = container.bytes.part(chunk.offset, chunk.length);
    const bool changes = container.bin && container.bin->offset == chunk.offset;
    chunks.push_back({chunk.type, changes ? changed_bin(data, bin) : Pieces{data}});
  }
  Pieces pieces(1);
  std::uint64_t total = kHeader;
  for (const auto& [type, data] : chunks) {
    const std::size_t size = size_of(data);
    total += kChunkHeader + std::uint64_t{padded(size)};
    pieces.push_back(Bytes::from_string(chunk_header(type, padded(size))));
    pieces.insert(pieces.end(), data.begin(), data.end());
    const char blank = type == container::kChunkJson ? ' ' : '\0';
    pieces.push_back(Bytes::from_string(std::string(padded(size) - size, blank)));
  }
  if (total > UINT32_MAX) return Error{"the new file exceeds the maximum size of a GLB (4 GiB)"};
  std::string head(container.bytes.text().substr(0, kHeader - 4));  // magic and version
  append_little_endian(head, total);
  pieces.front() = Bytes::from_string(std::move(head));
  return pieces;
}

Result<Pieces> make_glb(std::string_view json, Pieces bin) {
  const std::string empty("glTF\2\0\0\0\x18\0\0\0\4\0\0\0JSON{}  ", 24);
  BinChange change;
  if (!bin.empty()) change.whole = std::move(bin);
  return rewrite_glb(container::open_bytes(Bytes::from_string(empty)), json, change);
}

Result<Pieces> rewrite(const container::Container& container) {
  if (container.format == container::Format::glb) return rewrite_glb(container, *container.json);
  return Pieces{Bytes::from_text(container.json)};
}

}  // namespace gltfx::change
