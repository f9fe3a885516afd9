// SPDX-License-Identifier: Apache-2.0
/// An unchanged JSON text, with every value and key as a span of it.
///
/// The document is one flat array in the order of the text: a container is followed by its
/// content, a key by its value. A node takes 16 bytes, and an array that holds nothing but numbers
/// is a single node whose elements are read from the text again on request. Line and column are
/// computed only for output (`json/lines.hpp`).
#pragma once

#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/pages.hpp"
#include "base/shared_text.hpp"
#include "base/span.hpp"
#include "json/keys.hpp"

namespace gltfx::json {

/// Position of a node in the document's array. 0 is the root.
using NodeId = std::uint32_t;

inline constexpr NodeId kNoNode = UINT32_MAX;

enum class Kind : std::uint8_t {
  null,
  false_value,
  true_value,
  number,
  string,
  array,         ///< elements are nodes
  number_array,  ///< one node; elements are numbers and have no nodes of their own. Never empty
  object,
  key,  ///< a member's name; its value is the next node
};

struct Node {
  std::uint32_t begin = 0;  ///< first byte of the token; a string's opening quote
  std::uint32_t end = 0;    ///< one past the last byte, closing bracket or quote
  std::uint32_t next = 0;   ///< node after this one's content; of a key: its KeyId
  Kind kind = Kind::null;
  bool escaped = false;      ///< string or key with a backslash in it
  bool hidden = false;       ///< a key whose member is hidden, or an object whose members are
  std::uint8_t numbers = 0;  ///< elements of a number_array; kManyNumbers: so many or more
};
static_assert(sizeof(Node) == 16);
inline constexpr std::uint8_t kManyNumbers = UINT8_MAX;
using NodeArray = std::vector<Node, PageAllocator<Node>>;

/// A number and its text.
struct Number {
  Span span;
  double value = 0;  ///< nearest double; an infinity when the literal is beyond its range
  /// Zero fraction and within +-2^53, so that it is exact: 1.0 and 1e3 count.
  bool is_integer() const;
};

class Document;

/// Forward range over the visible members of an object, in the order of the text.
class Members {
 public:
  struct Member {
    NodeId key;
    NodeId value;
    KeyId key_id;
  };
  class Iterator {
   public:
    Iterator(const Document& document, NodeId at, NodeId end)
        : document_(&document), at_(at), end_(end) {}
    Member operator*() const;
    Iterator& operator++();
    bool operator!=(const Iterator& other) const { return at_ != other.at_; }

   private:
    friend class Members;
    void skip_hidden();
    const Document* document_;
    NodeId at_;
    NodeId end_;
  };
  Members(const Document& document, NodeId object) : document_(&document), object_(object) {}
  Iterator begin() const;
  Iterator end() const;

 private:
  const Document* document_;
  NodeId object_;
};

/// Forward range over the element nodes of an `array` (not of a `number_array`).
class Elements {
 public:
  class Iterator {
   public:
    Iterator(const Document& document, NodeId at) : document_(&document), at_(at) {}
    NodeId operator*() const { return at_; }
    inline Iterator& operator++();
    bool operator!=(const Iterator& other) const { return at_ != other.at_; }

   private:
    const Document* document_;
    NodeId at_;
  };
  Elements(const Document& document, NodeId array) : document_(&document), array_(array) {}
  Iterator begin() const;
  Iterator end() const;

 private:
  const Document* document_;
  NodeId array_;
};

/// Reads the numbers of a `number_array` one after the other.
///
///     for (NumberCursor at(document, id); at.valid(); at.advance()) use(at.number());
class NumberCursor {
 public:
  NumberCursor(const Document& document, NodeId number_array);
  bool valid() const { return valid_; }
  const Number& number() const { return number_; }
  void advance();

 private:
  void read();
  std::string_view text_;
  std::uint32_t at_ = 0;
  std::uint32_t end_ = 0;
  bool valid_ = false;
  Number number_;
};

/// Immutable once built, except for hide() and strip(); any number of threads may read it. Of
/// members with one name the last is visible. Owns its text. A default-constructed document has no
/// nodes: check `empty()` before `root()`.
class Document {
 public:
  Document() = default;

  std::string_view text() const { return text_ ? *text_ : std::string_view(); }
  bool empty() const { return nodes_.empty(); }
  NodeId root() const { return 0; }
  std::size_t node_count() const { return nodes_.size(); }
  const Node& node(NodeId id) const { return nodes_[id]; }
  Kind kind(NodeId id) const { return nodes_[id].kind; }
  Span span(NodeId id) const { return {nodes_[id].begin, nodes_[id].end}; }
  /// The bytes of a value in the text; a string with its quotes.
  std::string_view raw(NodeId id) const { return span(id).in(text()); }
  /// The node after this value and all of its content.
  NodeId next(NodeId id) const { return nodes_[id].next; }

  bool is_object(NodeId id) const { return kind(id) == Kind::object; }
  bool is_array(NodeId id) const {
    return kind(id) == Kind::array || kind(id) == Kind::number_array;
  }
  bool is_string(NodeId id) const { return kind(id) == Kind::string; }
  bool is_number(NodeId id) const { return kind(id) == Kind::number; }
  bool is_boolean(NodeId id) const {
    return kind(id) == Kind::true_value || kind(id) == Kind::false_value;
  }

  Members members(NodeId object) const { return {*this, object}; }
  Elements elements(NodeId array) const { return {*this, array}; }

  /// Number of elements of any array; linear in a number_array of many.
  std::size_t array_size(NodeId array) const;
  /// Number of visible members of an object; linear in it.
  std::size_t object_size(NodeId object) const;

  /// The value of the last member with that name (of repeated names the last wins), or kNoNode.
  /// Also kNoNode when `object` is not an object or is kNoNode. Logarithmic in a large object.
  NodeId find(NodeId object, std::string_view name) const;
  NodeId find(NodeId object, KeyId name) const;
  /// As find(), but hidden members are found as well.
  NodeId find_in_text(NodeId object, std::string_view name) const;
  bool holds(NodeId object, std::string_view name) const {
    return find_in_text(object, name) != kNoNode;
  }
  /// As holds(), but a hidden null counts as no member.
  bool has_value(NodeId object, std::string_view name) const;

  /// Hides a member: find() and members() act as if it were not in the text. `value` is the
  /// member's value.
  void hide(NodeId value) { nodes_[value - 1].hidden = true; }
  bool is_hidden(NodeId value) const { return nodes_[value - 1].hidden; }
  /// Makes any value an object without members.
  void strip(NodeId value) {
    nodes_[value].kind = Kind::object;
    nodes_[value].hidden = true;
  }

  /// Precondition: kind(id) == Kind::number.
  Number number(NodeId id) const;
  /// The number at `id` if it is a number with zero fraction, at least 0 and at most 2^53.
  std::optional<std::uint64_t> unsigned_integer(NodeId id) const;
  /// The unescaped content of a string or key. A lone surrogate becomes U+FFFD.
  std::string string(NodeId id) const;
  /// The content, not copied when it has no escape, else unescaped into `buffer`.
  std::string_view string(NodeId id, std::string& buffer) const;
  /// Adds the content of a string to a table that does not outlive the document; says whether it is
  /// new.
  bool insert_string(NodeId id, KeyTable& table) const;

  /// Number of different member names; KeyIds are below it.
  std::size_t key_count() const { return keys_.size(); }
  /// The unescaped name of a KeyId.
  std::string_view key(KeyId id) const { return keys_.name(id); }
  /// The KeyId of a name, or kNoKey when no object of the document has it.
  KeyId key_id(std::string_view name) const { return keys_.find(name); }

  /// RFC 6901 pointer to a node: linear in the size of the containers above it. For many nodes
  /// build a `Path` while walking instead.
  std::string pointer_of(NodeId id) const;
  /// The value a pointer names, or kNoNode. An element of a number_array has no node: then the
  /// array's node is returned and `element` set.
  NodeId resolve(std::string_view pointer, std::optional<std::uint64_t>* element = nullptr) const;

 private:
  friend class Parser;
  /// In an object with at most this many members, find() compares names.
  static constexpr std::uint32_t kFewMembers = 16;
  /// An object with at least this many members also has them sorted by name.
  static constexpr std::uint32_t kManyMembers = 64;
  /// Values of its members: from `begin` to `end` in sorted_values_.
  struct LargeObject {
    NodeId object;
    std::uint32_t begin;
    std::uint32_t end;
  };
  /// An array of values with at least this many elements has its size stored.
  static constexpr std::uint32_t kManyElements = 64;
  struct LargeArray {
    NodeId array;
    std::uint32_t size;
  };
  void sort_members(NodeId object);
  void sort_large();
  NodeId last_member(NodeId object, KeyId name) const;
  KeyId key_of(NodeId value) const { return nodes_[value - 1].next; }

  SharedText text_;
  NodeArray nodes_;
  KeyTable keys_;
  std::vector<LargeArray> large_arrays_;    ///< by node
  std::vector<LargeObject> large_objects_;  ///< by node
  std::vector<NodeId> sorted_values_;       ///< by key; those of a repeated name as in the text
};

inline Elements::Iterator& Elements::Iterator::operator++() {
  at_ = document_->next(at_);
  return *this;
}

inline Elements::Iterator Elements::begin() const { return {*document_, array_ + 1}; }

inline Elements::Iterator Elements::end() const {
  const bool has_elements = document_->kind(array_) == Kind::array;
  return {*document_, has_elements ? document_->next(array_) : array_ + 1};
}

}  // namespace gltfx::json
