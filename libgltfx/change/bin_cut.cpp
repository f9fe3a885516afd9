// SPDX-License-Identifier: Apache-2.0
#include "change/bin_cut.hpp"

#include <algorithm>
#include <string>

#include "change/buffer_layout.hpp"
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
void shorten_buffer(const graph::Tree& tree, std::vector<ByteRange>& cut, json::Editor& editor) {
  const json::Document& document = tree.document();
  const json::NodeId buffer = tree.element(tree.member(document.root(), "buffers"), 0);
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

}  // namespace

std::vector<ByteRange> cut_bin(const graph::Graph& graph,
                               const std::function<bool(json::NodeId object)>& goes,
                               std::uint64_t size, json::Editor& editor) {
  const auto users = buffer_users(graph);
  if (!users) return {};
  std::vector<Part> parts;
  for (const BufferUser& user : *users) {
    if (user.buffer == 0) parts.push_back({user, goes(user.object)});
  }
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return a.user.bytes.begin < b.user.bytes.begin;
  });
  std::vector<ByteRange> cut = words_of(parts, size);
  if (cut.empty()) return cut;
  shorten_buffer(graph.tree(), cut, editor);
  if (!cut.empty()) move_parts(graph.tree().document(), parts, cut, editor);
  return cut;
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
