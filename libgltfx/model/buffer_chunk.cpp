// SPDX-License-Identifier: Apache-2.0
#include "model/buffer_chunk.hpp"

#include <algorithm>

namespace gltfx::model {

json::NodeId chunk_member(const json::Document& document, json::NodeId buffer,
                          const schema::Version& version) {
  return version > schema::kVersion2 ? document.find(buffer, "chunk") : json::kNoNode;
}

std::optional<std::uint64_t> chunk_number(const json::Document& document, json::NodeId buffer,
                                          std::uint64_t index, const schema::Version& version) {
  if (document.holds(buffer, "uri")) return std::nullopt;
  const json::NodeId member = chunk_member(document, buffer, version);
  if (member != json::kNoNode) return document.unsigned_integer(member);
  return index == 0 ? std::optional<std::uint64_t>(1) : std::nullopt;
}

std::optional<container::Chunk> chunk_of(const container::Container& container,
                                         const json::Document& document, json::NodeId buffer,
                                         std::uint64_t index, const schema::Version& version) {
  if (document.holds(buffer, "uri")) return std::nullopt;
  const json::NodeId member = chunk_member(document, buffer, version);
  if (member == json::kNoNode) return index == 0 ? container.bin : std::nullopt;
  const auto chunk = document.unsigned_integer(member);
  if (!chunk || *chunk >= container.chunks.size()) return std::nullopt;
  const container::Chunk& found = container.chunks[*chunk];
  if (found.type != container::kChunkBin || found.encoding != 0) return std::nullopt;
  return found;
}

std::size_t position_of(const container::Container& container, const container::Chunk& chunk) {
  const auto found = std::lower_bound(
      container.chunks.begin(), container.chunks.end(), chunk.header_offset,
      [](const container::Chunk& each, std::uint64_t at) { return each.header_offset < at; });
  return static_cast<std::size_t>(found - container.chunks.begin());
}

}  // namespace gltfx::model
