// SPDX-License-Identifier: Apache-2.0
#include "change/bin_cut.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

#include "graph/unknown_indices.hpp"
#include "model/buffer_chunk.hpp"
#include "model/fields.hpp"

namespace gltfx::change {
namespace {

constexpr std::uint64_t kWord = 8;

/// A part of the chunk.
struct Part {
  BufferUser user;
  bool goes;
};

// For each part, the begin of the next part that stays.
std::vector<std::uint64_t> next_begins(const std::vector<Part>& parts) {
  std::vector<std::uint64_t> begins(parts.size());
  std::uint64_t next = UINT64_MAX;
  for (std::size_t i = parts.size(); i > 0; --i) {
    begins[i - 1] = next;
    if (!parts[i - 1].goes) next = parts[i - 1].user.bytes.begin;
  }
  return begins;
}

// Whole words that contain only removed parts and padding between them; at the end of the chunk,
// all bytes of these.
std::vector<ByteRange> words_of(const std::vector<Part>& parts, std::uint64_t size) {
  const std::vector<std::uint64_t> next = next_begins(parts);
  std::vector<ByteRange> cut;
  std::uint64_t kept = 0;  // end of all parts so far that stay, and of the cut ranges
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::uint64_t end = parts[i].user.bytes.end;
    if (parts[i].goes) {
      std::uint64_t begin = std::max(parts[i].user.bytes.begin, kept);
      end = std::min({(end + kWord - 1) / kWord * kWord, next[i], size});
      if (next[i] == UINT64_MAX) {  // the end of the chunk has no alignment to keep
        if (begin - kept < kWord) begin = kept;
      } else {
        end = std::max(begin, begin + (end - std::min(begin, end)) / kWord * kWord);
      }
      if (end <= begin) continue;
      cut.push_back({begin, end});
    }
    kept = std::max(kept, end);
  }
  return cut;
}

// A buffer must keep at least one byte; if none would be left, nothing is cut.
void shorten_buffer(const graph::Tree& tree, std::uint64_t index, std::vector<ByteRange>& cut,
                    json::Editor& editor) {
  const json::Document& document = tree.document();
  const json::NodeId buffer = tree.element(tree.member(document.root(), "buffers"), index);
  const std::uint64_t old = model::unsigned_member(document, buffer, "byteLength").value_or(0);
  std::uint64_t left = old;
  for (const ByteRange& range : cut) left -= std::min(range.end, old) - std::min(range.begin, old);
  if (left == 0) cut.clear();
  if (left == 0 || left == old) return;
  editor.replace_scalar(document.find(buffer, "byteLength"), std::to_string(left));
}

void move_parts(const json::Document& document, const std::vector<Part>& parts,
                const std::vector<ByteRange>& cut, json::Editor& editor) {
  std::uint64_t gone = 0;
  auto range = cut.begin();
  for (const Part& part : parts) {
    const std::uint64_t begin = part.user.bytes.begin;
    for (; range != cut.end() && range->end <= begin; ++range) gone += range->end - range->begin;
    if (!part.goes) move_user(document, part.user, begin - gone, editor);
  }
}

using Goes = std::function<bool(json::NodeId object)>;

/// The buffers of an asset and their BIN chunks.
class ChunkBuffers {
 public:
  ChunkBuffers(const graph::Graph& graph, const container::Container& container)
      : document_(graph.tree().document()),
        container_(container),
        version_(schema::stated_version(document_)) {
    const json::NodeId list = graph.tree().member(document_.root(), "buffers");
    const std::uint64_t count = list == json::kNoNode ? 0 : graph.tree().size(list);
    for (std::uint64_t i = 0; i < count; ++i) {
      const json::NodeId buffer = graph.tree().element(list, i);
      const bool is_object = buffer != json::kNoNode && document_.is_object(buffer);
      buffers_.push_back(is_object ? buffer : json::kNoNode);
      if (!is_object) continue;
      const auto chunk = model::chunk_of(container, document_, buffer, i, version_);
      if (chunk) of_[model::position_of(container, *chunk)].push_back(i);
    }
  }

  /// Indices of buffers, by the position of their chunk.
  const std::map<std::size_t, std::vector<std::uint64_t>>& of() const { return of_; }
  json::NodeId buffer(std::uint64_t index) const { return buffers_[index]; }

  std::vector<std::size_t> without_buffers(const Goes& goes) const {
    std::vector<std::size_t> found;
    for (const auto& [position, indices] : of_) {
      const bool all = std::all_of(indices.begin(), indices.end(),
                                   [&](std::uint64_t i) { return goes(buffers_[i]); });
      if (all) found.push_back(position);
    }
    return found;
  }

  // Whether the first buffer that is left would be the BIN chunk, which it was not.
  bool has_heir(const Goes& goes, const std::vector<std::size_t>& dropped) const {
    const auto first = std::find_if(buffers_.begin(), buffers_.end(), [&](json::NodeId buffer) {
      return buffer != json::kNoNode && !goes(buffer);
    });
    if (first == buffers_.end() || document_.holds(*first, "uri")) return false;
    if (model::chunk_member(document_, *first, version_) != json::kNoNode) return false;
    if (first == buffers_.begin() && container_.bin) return false;
    return has_implicit(dropped);
  }

  // Gives the members `chunk` of buffers that are left the new positions.
  void renumber(const Goes& goes, const std::vector<std::size_t>& dropped, json::Editor& editor) {
    for (const json::NodeId buffer : buffers_) {
      if (buffer == json::kNoNode || goes(buffer)) continue;
      const json::NodeId member = model::chunk_member(document_, buffer, version_);
      const auto old = document_.unsigned_integer(member);
      if (!old) continue;
      const auto before = std::lower_bound(dropped.begin(), dropped.end(), *old);
      const auto gone = static_cast<std::uint64_t>(before - dropped.begin());
      if (gone > 0) editor.replace_scalar(member, std::to_string(*old - gone));
    }
  }

 private:
  // Whether the GLB has a chunk for a first buffer that names none, when others are dropped.
  bool has_implicit(const std::vector<std::size_t>& dropped) const {
    const auto is_dropped = [&](std::size_t position) {
      return std::binary_search(dropped.begin(), dropped.end(), position);
    };
    if (container_.glb_version != 3U) {
      return container_.bin && !is_dropped(model::position_of(container_, *container_.bin));
    }
    const std::array<std::uint32_t, 2> wanted{container::kChunkJson, container::kChunkBin};
    std::size_t found = 0;
    for (std::size_t i = 0; i < container_.chunks.size() && found < wanted.size(); ++i) {
      if (is_dropped(i)) continue;
      const container::Chunk& chunk = container_.chunks[i];
      if (chunk.type != wanted[found] || chunk.encoding != 0) return false;
      ++found;
    }
    return found == wanted.size();
  }

  const json::Document& document_;
  const container::Container& container_;
  const schema::Version version_;
  std::vector<json::NodeId> buffers_;
  std::map<std::size_t, std::vector<std::uint64_t>> of_;
};

}  // namespace

std::vector<ByteRange> cut_bin(const graph::Tree& tree, const std::vector<BufferUser>& users,
                               const Goes& goes, std::uint64_t size, json::Editor& editor) {
  std::vector<Part> parts;
  for (const BufferUser& user : users) parts.push_back({user, goes(user.object)});
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return a.user.bytes.begin < b.user.bytes.begin;
  });
  std::vector<ByteRange> cut = words_of(parts, size);
  if (cut.empty()) return cut;
  shorten_buffer(tree, users.front().buffer, cut, editor);
  if (!cut.empty()) move_parts(tree.document(), parts, cut, editor);
  return cut;
}

Result<BinChanges> drop_bins(const graph::Graph& graph, const container::Container& container,
                             const Goes& goes, json::Editor& editor) {
  ChunkBuffers buffers(graph, container);
  std::vector<std::size_t> dropped = buffers.without_buffers(goes);
  const bool renumbers = !dropped.empty() && dropped.front() + 1 < container.chunks.size();
  const bool is_doubtful = container.glb_version == 3U && renumbers &&
                           graph::find_unknown_with_integer(graph) != json::kNoNode;
  if (is_doubtful) dropped.clear();
  if (buffers.has_heir(goes, dropped)) {
    return Error{"another buffer would become that of the BIN chunk"};
  }
  buffers.renumber(goes, dropped, editor);
  BinChanges changes;
  for (const std::size_t position : dropped) changes[position].drop = true;
  return changes;
}

Result<BinChanges> cut_bins(const graph::Graph& graph, const container::Container& container,
                            const Goes& goes, json::Editor& editor) {
  auto changes = drop_bins(graph, container, goes, editor);
  const auto all = buffer_users(graph);
  if (!changes || !all) return changes;
  std::map<std::uint64_t, std::vector<BufferUser>> users;
  for (const BufferUser& user : *all) users[user.buffer].push_back(user);
  const ChunkBuffers buffers(graph, container);
  for (const auto& [position, indices] : buffers.of()) {
    if (indices.size() > 1 || goes(buffers.buffer(indices.front()))) continue;
    auto cut = cut_bin(graph.tree(), users[indices.front()], goes,
                       container.chunks[position].length, editor);
    if (!cut.empty()) (*changes)[position].cut = std::move(cut);
  }
  return changes;
}

std::vector<container::Bytes> without(const container::Bytes& data,
                                      const std::vector<ByteRange>& cut) {
  std::vector<container::Bytes> pieces;
  std::uint64_t at = 0;
  for (const ByteRange& range : cut) {
    pieces.push_back(data.part(at, range.begin - at));
    at = range.end;
  }
  pieces.push_back(data.part(at, data.size() - at));
  return pieces;
}

}  // namespace gltfx::change
