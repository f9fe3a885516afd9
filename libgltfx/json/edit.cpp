// SPDX-License-Identifier: Apache-2.0
#include "json/edit.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "json/writer.hpp"

namespace gltfx::json {
namespace {

std::string between_items(const Layout& layout) {
  return layout.line_end.empty() ? layout.gap : layout.line_end + layout.indent;
}

/// A piece of an edited text: bytes of the old text, or new ones.
struct Piece {
  bool old = false;
  Span span;              ///< place in the old text
  std::string_view text;  ///< new text
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

/// Makes edits from the kept pieces of a text and the new text between them.
class Collector {
 public:
  void add(std::string_view text) { pending_ += text; }
  // The part [from, from + size) of a piece.
  void keep(const Piece& piece, std::size_t from, std::size_t size) {
    if (size == 0) return;
    if (!piece.old) return add(piece.text.substr(from, size));
    const auto begin = piece.span.begin + static_cast<std::uint32_t>(from);
    resolve(begin);
    at_ = begin + static_cast<std::uint32_t>(size);
  }
  std::vector<Edit> finish(std::size_t end) {
    resolve(static_cast<std::uint32_t>(end));
    return std::move(edits_);
  }

 private:
  void resolve(std::uint32_t begin) {
    if (begin != at_ || !pending_.empty()) edits_.push_back({{at_, begin}, std::move(pending_)});
    pending_.clear();
  }

  std::vector<Edit> edits_;
  std::string pending_;
  std::uint32_t at_ = 0;
};

}  // namespace

std::string apply_edits(std::string_view text, std::span<const Edit> edits) {
  std::size_t size = text.size();
  for (const Edit& edit : edits) size += edit.text.size() - edit.span.size();
  std::string out;
  out.reserve(size);
  std::size_t at = 0;
  for (const Edit& edit : edits) {
    out += text.substr(at, edit.span.begin - at);
    out += edit.text;
    at = edit.span.end;
  }
  out += text.substr(at);
  return out;
}

Relocation::Relocation(std::span<const Edit> edits) {
  std::uint32_t at = 0;
  std::uint32_t behind = 0;  // position of `at` in the new text
  for (const Edit& edit : edits) {
    const std::uint32_t begin = behind + (edit.span.begin - at);
    behind = begin + static_cast<std::uint32_t>(edit.text.size());
    at = edit.span.end;
    moved_.push_back({edit.span, {begin, behind}});
  }
}

Span Relocation::of(std::uint32_t at) const {
  const auto next = std::upper_bound(
      moved_.begin(), moved_.end(), at,
      [](std::uint32_t byte, const Moved& moved) { return byte < moved.from.begin; });
  if (next == moved_.begin()) return {at, at + 1};
  const Moved& before = *std::prev(next);
  if (at < before.from.end) return before.to;
  const std::uint32_t now = before.to.end + (at - before.from.end);
  return {now, now + 1};
}

std::vector<Edit> merge_edits(std::vector<Edit> a, std::vector<Edit> b) {
  std::vector<Edit> all;
  all.reserve(a.size() + b.size());
  std::merge(std::make_move_iterator(a.begin()), std::make_move_iterator(a.end()),
             std::make_move_iterator(b.begin()), std::make_move_iterator(b.end()),
             std::back_inserter(all), [](const Edit& one, const Edit& other) {
               if (one.span.begin != other.span.begin) return one.span.begin < other.span.begin;
               return one.span.end < other.span.end;
             });
  return all;
}

void Editor::add(std::uint32_t begin, std::uint32_t end, std::string text) {
  edits_.push_back({{begin, end}, std::move(text)});
}

void Editor::rename(NodeId key, std::string_view name) {
  std::string text;
  append_string(text, name);
  const Span span = document_.span(key);
  add(span.begin, span.end, std::move(text));
}

void Editor::replace(NodeId container, NodeId value, std::string_view json) {
  const Span span = document_.span(value);
  add(span.begin, span.end, lay_out(json, layout_.of(container)));
}

void Editor::replace_scalar(NodeId value, std::string json) {
  const Span span = document_.span(value);
  add(span.begin, span.end, std::move(json));
}

void Editor::enclose(NodeId container, NodeId value, std::string_view name) {
  const Layout layout = layout_.of(container);
  std::string before = "{" + layout.padding;
  append_string(before, name);
  before += layout.colon;
  const Span span = document_.span(value);
  add(span.begin, span.begin, std::move(before));
  add(span.end, span.end, layout.padding + "}");
}

void Editor::remove(NodeId container, NodeId item) { removed_.push_back({container, item}); }

void Editor::remove_number(NodeId number_array, std::uint32_t index) {
  removed_.push_back({number_array, index});
}

void Editor::append_member(NodeId object, std::string_view name, std::string_view json) {
  const Layout layout = layout_.of(object);
  std::string text;
  append_string(text, name);
  text += layout.colon;
  text += lay_out(json, layout);
  added_.push_back({object, std::move(text)});
}

void Editor::append_element(NodeId array, std::string_view json) {
  added_.push_back({array, lay_out(json, layout_.of(array))});
}

std::vector<Editor::Item> Editor::items(NodeId container, const Change& change) const {
  std::vector<Item> all;
  const auto is_kept = [&](NodeId item) {
    const Removal removal{container, item};
    return !std::binary_search(change.removed.begin(), change.removed.end(), removal);
  };
  if (document_.kind(container) == Kind::number_array) {
    std::uint32_t index = 0;
    for (NumberCursor at(document_, container); at.valid(); at.advance()) {
      all.push_back({at.number().span.begin, at.number().span.end, is_kept(index++)});
    }
    return all;
  }
  const bool object = document_.is_object(container);
  const NodeId end = document_.next(container);
  for (NodeId at = container + 1; at < end;) {
    const NodeId value = object ? at + 1 : at;
    all.push_back({document_.span(at).begin, document_.span(value).end, is_kept(at)});
    at = document_.next(value);
  }
  return all;
}

// Removes all items: only the brackets stay.
void Editor::refill(NodeId container, const Change& change) {
  const Span span = document_.span(container);
  if (change.added.empty()) return add(span.begin + 1, span.end - 1, {});
  const Layout layout = layout_.of(container);
  std::string text;
  for (const Addition& item : change.added) {
    if (!text.empty()) text += ',';
    if (!layout.line_end.empty()) {
      text += between_items(layout);
    } else {
      text += text.empty() ? layout.padding : layout.gap;
    }
    text += item.text;
  }
  if (layout.line_end.empty()) {
    text += layout.padding;
  } else {
    const std::string_view outer = layout.indent;
    const bool nested = outer.ends_with(layout.unit);
    text += layout.line_end;
    text += outer.substr(0, outer.size() - (nested ? layout.unit.size() : 0));
  }
  add(span.begin + 1, span.end - 1, std::move(text));
}

// An item is removed with the comma before it; the first items are removed with the comma after
// them.
void Editor::resolve(NodeId container, const Change& change) {
  const std::vector<Item> all = items(container, change);
  const auto is_kept = [](const Item& item) { return item.kept; };
  const auto first = std::find_if(all.begin(), all.end(), is_kept);
  if (first == all.end()) return refill(container, change);
  if (first != all.begin()) add(all.front().begin, first->begin, {});
  std::uint32_t end = first->end;  // of the last item that is kept
  bool gone = false;
  for (auto item = first; item != all.end(); ++item) {
    if (!item->kept) {
      gone = true;
      continue;
    }
    // From the end of the kept item before to that of the last one removed.
    if (std::exchange(gone, false)) add(end, std::prev(item)->end, {});
    end = item->end;
  }
  std::string text;
  const std::string gap = change.added.empty() ? "" : between_items(layout_.of(container));
  for (const Addition& item : change.added) text.append(1, ',').append(gap).append(item.text);
  if (gone || !text.empty()) add(end, all.back().end, std::move(text));
}

void Editor::resolve_changes() {
  std::sort(removed_.begin(), removed_.end());
  std::stable_sort(added_.begin(), added_.end(),
                   [](const Addition& a, const Addition& b) { return a.container < b.container; });
  std::span<const Removal> removed(removed_);
  std::span<Addition> added(added_);
  while (!removed.empty() || !added.empty()) {
    const NodeId container = std::min(removed.empty() ? kNoNode : removed.front().container,
                                      added.empty() ? kNoNode : added.front().container);
    const auto in_it = [container](const auto& change) { return change.container == container; };
    const auto count = [&](const auto& changes) {
      return static_cast<std::size_t>(std::find_if_not(changes.begin(), changes.end(), in_it) -
                                      changes.begin());
    };
    const auto added_here = added.first(count(added));
    resolve(container, {removed.first(count(removed)), added_here});
    for (Addition& addition : added_here) addition.text = {};  // it is in an edit now
    removed = removed.subspan(count(removed));
    added = added.subspan(added_here.size());
  }
  removed_ = {};
  added_ = {};
}

std::vector<Edit> Editor::take() {
  resolve_changes();
  std::stable_sort(edits_.begin(), edits_.end(), [](const Edit& a, const Edit& b) {
    if (a.span.begin != b.span.begin) return a.span.begin < b.span.begin;
    return a.span.end > b.span.end;
  });
  std::uint32_t end = 0;  // of the last one that is not inside another
  std::erase_if(edits_, [&](const Edit& edit) {
    if (edit.span.begin < end) return true;
    end = edit.span.end;
    return false;
  });
  return std::exchange(edits_, {});
}

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
      if (edit->span.end > end) break;  // continues in the next piece
    }
    collector.keep(piece, at - begin, end - at);
    begin = end;
  }
  for (; edit != second.end(); ++edit) collector.add(edit->text);  // after all pieces
  return collector.finish(text.size());
}

}  // namespace gltfx::json
