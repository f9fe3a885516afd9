// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "json/edit.hpp"

namespace gltfx::json {
namespace {

/// A stretch of a text that was edited: bytes of the old one, or new ones.
struct Piece {
  bool old = false;
  Span span;              ///< old: where it stood
  std::string_view text;  ///< else
  std::size_t size() const { return old ? span.end - span.begin : text.size(); }
};

std::vector<Piece> pieces_of(std::string_view text, std::span<const Edit> edits) {
  std::vector<Piece> pieces;
  std::uint32_t at = 0;
  for (const Edit& edit : edits) {
    pieces.push_back({true, {at, edit.span.begin}, {}});
    pieces.push_back({false, {}, edit.text});
    at = edit.span.end;
  }
  pieces.push_back({true, {at, static_cast<std::uint32_t>(text.size())}, {}});
  return pieces;
}

/// Makes edits of what is kept of a text and what stands between.
class Collector {
 public:
  void add(std::string_view text) { pending_ += text; }
  // The part [from, from + size) of a piece.
  void keep(const Piece& piece, std::size_t from, std::size_t size) {
    if (size == 0) return;
    if (!piece.old) return add(piece.text.substr(from, size));
    const auto begin = piece.span.begin + static_cast<std::uint32_t>(from);
    settle(begin);
    at_ = begin + static_cast<std::uint32_t>(size);
  }
  std::vector<Edit> finish(std::size_t end) {
    settle(static_cast<std::uint32_t>(end));
    return std::move(edits_);
  }

 private:
  void settle(std::uint32_t begin) {
    if (begin != at_ || !pending_.empty()) edits_.push_back({{at_, begin}, std::move(pending_)});
    pending_.clear();
  }

  std::vector<Edit> edits_;
  std::string pending_;
  std::uint32_t at_ = 0;
};

}  // namespace

std::vector<Edit> chain_edits(std::string_view text, std::span<const Edit> first,
                              std::span<const Edit> second) {
  Collector collector;
  std::size_t begin = 0;  // of the piece, in the text between
  auto edit = second.begin();
  for (const Piece& piece : pieces_of(text, first)) {
    const std::size_t end = begin + piece.size();
    std::size_t at = begin;
    for (; edit != second.end() && edit->span.begin < end; ++edit) {
      if (edit->span.begin >= begin) {
        collector.keep(piece, at - begin, edit->span.begin - at);
        collector.add(edit->text);
      }
      at = std::min<std::size_t>(end, edit->span.end);
      if (edit->span.end > end) break;  // goes on in the next piece
    }
    collector.keep(piece, at - begin, end - at);
    begin = end;
  }
  for (; edit != second.end(); ++edit) collector.add(edit->text);  // behind all of it
  return collector.finish(text.size());
}

}  // namespace gltfx::json
