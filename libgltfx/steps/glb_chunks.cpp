// SPDX-License-Identifier: Apache-2.0
#include "steps/glb_chunks.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "base/text.hpp"
#include "change/rewrite.hpp"
#include "model/buffer_chunk.hpp"

namespace gltfx::steps {
namespace {

using container::Chunk;
using container::Container;

bool is_plain_bin(const Chunk& chunk) {
  return chunk.type == container::kChunkBin && chunk.encoding == 0;
}

// Why version 2 cannot hold a chunk; empty: it can, or the chunk is a part of the BIN chunk.
std::string find_chunk_loss(const Container& container, const Chunk& chunk,
                            const std::set<std::uint64_t>& used) {
  if (chunk.offset == container.json_offset || chunk.length == 0) return {};
  if (chunk.encoding != 0) return "has an encoding, which version 2 does not state";
  if (chunk.type == container::kChunkJson) return "is a second JSON chunk";
  const bool is_unused = is_plain_bin(chunk) && !used.contains(chunk.offset);
  if (!is_unused || lone_bin(container)) return {};
  return "is the data of no buffer, and version 2 has one BIN chunk";
}

}  // namespace

std::string chunk_type(const Chunk& chunk) {
  std::string letters;
  for (unsigned shift = 0; shift < 32; shift += 8) {
    letters += static_cast<char>((chunk.type >> shift) & 0xFFU);
  }
  return gltfx::quoted(letters);
}

std::set<std::uint64_t> used_chunks(const model::AssetBytes& bytes) {
  std::set<std::uint64_t> used;
  for (std::uint64_t i = 0; i < bytes.asset().count(model::RootArray::buffers); ++i) {
    if (const auto chunk = bytes.buffer_chunk(i)) used.insert(chunk->offset);
  }
  return used;
}

bool names_chunks(const json::Document& document) {
  const model::Asset asset(document);
  const auto& buffers = asset.elements(model::RootArray::buffers);
  const schema::Version version = schema::stated_version(document);
  return std::any_of(buffers.begin(), buffers.end(), [&](json::NodeId buffer) {
    return model::chunk_member(document, buffer, version) != json::kNoNode;
  });
}

std::optional<Chunk> lone_bin(const Container& container) {
  const auto& chunks = container.chunks;
  const auto first = std::find_if(chunks.begin(), chunks.end(), is_plain_bin);
  if (first == chunks.end()) return std::nullopt;
  if (std::find_if(first + 1, chunks.end(), is_plain_bin) != chunks.end()) return std::nullopt;
  return *first;
}

void note_chunks(const Container& container, const std::set<std::uint64_t>& used,
                 std::uint32_t version, ConvertStep& row) {
  const auto& chunks = container.chunks;
  const bool has_bin =
      version == 3 ? container.bin.has_value() : !used.empty() || lone_bin(container).has_value();
  std::size_t next = has_bin ? 2 : 1;
  const auto lose = [&row](std::string what) { row.losses.push_back({std::move(what), 0, 0, {}}); };
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    if (version == 2) {
      const std::string why = find_chunk_loss(container, chunks[i], used);
      if (!why.empty()) {
        row.refused.push_back({{}, fmt::format("chunk {} ({}) {}", i, chunk_type(chunks[i]), why)});
        lose(fmt::format("chunk {} ({})", i, chunk_type(chunks[i])));
        continue;
      }
    }
    if (!change::is_copied(container, chunks[i], version)) continue;
    if (i != next) {
      lose(fmt::format("the number of chunk {} ({}), which becomes {}", i, chunk_type(chunks[i]),
                       next));
    }
    ++next;
  }
}

}  // namespace gltfx::steps
