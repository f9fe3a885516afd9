// SPDX-License-Identifier: Apache-2.0
/// Changes to a JSON text that keep all other bytes.
#pragma once

#include <compare>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/span.hpp"
#include "json/document.hpp"
#include "json/layout.hpp"

namespace gltfx::json {

/// New text for a span of the old one; an empty span inserts.
struct Edit {
  Span span;
  std::string text;
  friend bool operator==(const Edit&, const Edit&) = default;
};

/// `text` with all edits made, in one pass. Precondition: they are sorted by place, are inside the
/// text and do not overlap, as Editor::take() gives them.
std::string apply_edits(std::string_view text, std::span<const Edit> edits);

/// The edits of two lists, each as Editor::take() gives them, as one. Precondition: no edit of one
/// overlaps any of the other. Of two insertions at one place that of `a` comes first.
std::vector<Edit> merge_edits(std::vector<Edit> a, std::vector<Edit> b);

/// The edits of `first` and `second` as edits of `text`. `second` edits the text that `first` makes
/// of `text`. Both lists are as Editor::take() gives them.
std::vector<Edit> chain_edits(std::string_view text, std::span<const Edit> first,
                              std::span<const Edit> second);

/// The positions of the bytes of a text after edits, which are as Editor::take() gives them.
class Relocation {
 public:
  explicit Relocation(std::span<const Edit> edits);
  /// The byte at `at` in the new text; if it is gone, the text in its place.
  Span of(std::uint32_t at) const;

 private:
  struct Moved {
    Span from, to;
  };
  std::vector<Moved> moved_;
};

/// Collects changes to members and elements of one document and turns them into edits. New text
/// follows the indentation, line ends and spacing of the text around it. The document may have
/// recoverable errors; those in removed and replaced values disappear, all others stay. Keeps a
/// reference to the document.
class Editor {
 public:
  explicit Editor(const Document& document) : document_(document), layout_(document) {}

  /// Gives a member another name; its value stays.
  void rename(NodeId key, std::string_view name);
  /// Replaces a value by a JSON value. `container` holds the value.
  void replace(NodeId container, NodeId value, std::string_view json);
  /// Replaces a number, literal or string by another.
  void replace_scalar(NodeId value, std::string json);
  /// Replaces a value by a new object whose only member it is, unchanged. The line is not broken;
  /// spacing follows that of `container`, which holds the value.
  void enclose(NodeId container, NodeId value, std::string_view name);
  /// Replaces a number, a node or an element of a number_array, by text.
  void replace_text(Span span, std::string text) { add(span.begin, span.end, std::move(text)); }
  /// Removes a member (by its key) or an element of `container`, with its comma.
  void remove(NodeId container, NodeId item);
  /// Removes an element of a number_array, with its comma.
  void remove_number(NodeId number_array, std::uint32_t index);
  /// Adds a member at the end of an object.
  void append_member(NodeId object, std::string_view name, std::string_view json);
  /// Adds an element at the end of an array, which must not be a number_array.
  void append_element(NodeId array, std::string_view json);

  /// The edits, sorted. Edits inside removed or replaced values are left out.
  std::vector<Edit> take();

 private:
  struct Removal {
    NodeId container;
    NodeId item;  ///< of a number_array: the index of the element
    friend auto operator<=>(const Removal&, const Removal&) = default;
  };
  struct Addition {
    NodeId container;
    std::string text;
  };
  /// All changes of one container.
  struct Change {
    std::span<const Removal> removed;  ///< sorted
    std::span<const Addition> added;
  };
  struct Item {
    std::uint32_t begin;
    std::uint32_t end;
    bool kept;
  };
  void resolve_changes();
  std::vector<Item> items(NodeId container, const Change& change) const;
  void resolve(NodeId container, const Change& change);
  void refill(NodeId container, const Change& change);
  void add(std::uint32_t begin, std::uint32_t end, std::string text);

  const Document& document_;
  LayoutFinder layout_;
  std::vector<Removal> removed_;
  std::vector<Addition> added_;
  std::vector<Edit> edits_;
};

}  // namespace gltfx::json
