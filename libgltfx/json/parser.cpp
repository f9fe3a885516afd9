// SPDX-License-Identifier: Apache-2.0
#include "json/parser.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "json/literals.hpp"
#include "json/scan.hpp"
#include "json/syntax_errors.hpp"

namespace gltfx::json {

Parser::Parser(SharedText text, const Limits& limits)
    : limits_(limits), nodes_(document_.nodes_), keys_(document_.keys_) {
  document_.text_ = std::move(text);
  begin_ = document_.text_->data();
  end_ = begin_ + document_.text_->size();
}

// Adds a node. The two functions that run for every number and node come first, to be inlined.
inline NodeId Parser::add(Kind kind, const char* begin, const char* end) {
  const auto id = static_cast<NodeId>(nodes_.size());
  if (id == nodes_.capacity()) [[unlikely]]
    reserve_more(begin);
  nodes_.push_back({offset(begin), offset(end), id + 1, kind, false, 0});
  return id;
}

inline const char* Parser::checked_number(const char* p) {
  const NumberScan scan = scan_number(p, end_);
  if (scan.end == nullptr) return fail(explain_number(text(), offset(p)));
  if (scan.may_overflow) warn_if_infinite(span(p, scan.end));
  return scan.end;
}

const char* Parser::root(const char* p) {
  p = value(skip_space(p, end_));
  while (p != nullptr && !frames_.empty()) {
    p = frames_.back().is_object ? member(p) : element(p);
  }
  if (p == nullptr) return nullptr;
  p = skip_space(p, end_);
  if (p == end_) return p;
  // A string before a colon is a member without an object around it.
  if (*p == ':' && nodes_[0].kind == Kind::string) {
    return unexpected(begin_ + nodes_[0].begin, Expected::root);
  }
  return unexpected(p, Expected::end);
}

const char* Parser::value(const char* p) {
  switch (*p) {
    case '"':
      return string(p, Kind::string);
    case '{':
      return object(p);
    case '[':
      return array(p);
    case 't':
      return literal(p, "true", Kind::true_value);
    case 'f':
      return literal(p, "false", Kind::false_value);
    case 'n':
      return literal(p, "null", Kind::null);
    default:
      return starts_number(*p) ? number(p) : bad_value(p);
  }
}

const char* Parser::member(const char* p) {
  p = separator(skip_space(p, end_), '}');
  if (p == nullptr) return nullptr;
  if (*p == '}') return close(p);
  p = name(p);
  if (p == nullptr) return nullptr;
  p = skip_space(p, end_);
  if (*p != ':') return unexpected(p, Expected::colon);
  return value(skip_space(p + 1, end_));
}

const char* Parser::element(const char* p) {
  p = separator(skip_space(p, end_), ']');
  if (p == nullptr) return nullptr;
  if (*p == ']') return close(p);
  ++frames_.back().elements;
  return value(p);
}

// From the end of an item to the next one or to the closing bracket.
const char* Parser::separator(const char* p, char closing) {
  if (*p == ',') {
    if (is_fresh()) return closing == '}' ? unexpected(p, Expected::name_or_brace) : bad_value(p);
    const char* const comma = p;
    p = skip_space(p + 1, end_);
    if (*p == closing) {
      warn(SyntaxError::trailing_comma, span(comma, comma + 1), "trailing comma");
    } else if (closing == '}' && *p != '"') {
      return unexpected(p, Expected::name);
    }
    return p;
  }
  if (*p == closing) return p;
  if (is_fresh()) {
    return closing == '}' && *p != '"' ? unexpected(p, Expected::name_or_brace) : p;
  }
  if (!can_follow_without_comma(p)) {
    return unexpected(p, closing == '}' ? Expected::comma_or_brace : Expected::comma_or_bracket);
  }
  warn(SyntaxError::missing_comma, token_at(text(), offset(p)), "missing ',' before this item");
  return p;
}

const char* Parser::name(const char* p) {
  Frame& object = frames_.back();
  const char* behind = name_as_guessed(p);
  if (behind == nullptr) {
    behind = string(p, Kind::key);
    if (behind == nullptr) return nullptr;
    object.key = intern(static_cast<NodeId>(nodes_.size() - 1));
    if (!nodes_.back().escaped) next_keys_[object.slot] = object.key;
    nodes_.back().next = object.key;
  }
  object.slot = 2 * (object.key + 1);
  return behind;
}

// Objects of one kind usually have their members in one order: the name is mostly the one that was
// here the last time, and a comparison is cheaper than a scan and a hash.
const char* Parser::name_as_guessed(const char* p) {
  Frame& object = frames_.back();
  const KeyId guess = next_keys_[object.slot];
  if (guess == kNoKey) return nullptr;
  const std::string_view name = keys_.name(guess);
  const std::size_t room = static_cast<std::size_t>(end_ - p);
  if (room < name.size() + 2 || p[name.size() + 1] != '"') return nullptr;
  if (!is_same({p + 1, name.size()}, name)) return nullptr;
  const char* const behind = p + name.size() + 2;
  nodes_[add(Kind::key, p, behind)].next = guess;
  object.key = guess;
  return behind;
}

KeyId Parser::intern(NodeId key) {
  const Node& node = nodes_[key];
  const std::string_view content = Span{node.begin + 1, node.end - 1}.in(text());
  KeyId id = kNoKey;
  if (node.escaped) {
    std::string buffer;
    append_unescaped(buffer, content);
    id = keys_.intern_copy(std::move(buffer));
  } else {
    id = keys_.intern(content);
  }
  if (id >= stamps_.size()) {
    stamps_.resize(id + std::size_t{1});
    next_keys_.resize(2 * (id + std::size_t{2}), kNoKey);
  }
  return id;
}

const char* Parser::string(const char* p, Kind kind) {
  const char* behind = skip_plain_string(p + 1, end_);
  if (*behind == '"') {
    add(kind, p, behind + 1);
    return behind + 1;
  }
  behind = string_with_escapes(p, behind);
  if (behind != nullptr) nodes_[add(kind, p, behind)].escaped = true;
  return behind;
}

const char* Parser::number(const char* p) {
  const char* const behind = checked_number(p);
  if (behind != nullptr) add(Kind::number, p, behind);
  return behind;
}

const char* Parser::literal(const char* p, std::string_view word, Kind kind) {
  const std::size_t size = word.size();
  if (static_cast<std::size_t>(end_ - p) < size || std::memcmp(p, word.data(), size) != 0 ||
      is_a(kWord, p[size])) {
    return bad_value(p);
  }
  add(kind, p, p + size);
  return p + size;
}

const char* Parser::object(const char* p) {
  if (frames_.size() >= limits_.depth) return too_deep(p);
  const NodeId node = add(Kind::object, p, p + 1);
  open(node, true);
  return p + 1;
}

const char* Parser::array(const char* p) {
  if (frames_.size() >= limits_.depth) return too_deep(p);
  const NodeId node = add(Kind::array, p, p + 1);
  const char* const first = skip_space(p + 1, end_);
  open(node, false);
  return starts_number(*first) ? number_array(node, first) : first;
}

// An array counts as one of numbers until another value is found; the numbers before it are then
// read again and become nodes.
const char* Parser::number_array(NodeId array, const char* p) {
  for (unsigned numbers = 1;; ++numbers) {
    p = checked_number(p);
    if (p == nullptr) return nullptr;
    p = skip_space(p, end_);
    if (*p == ',') {
      const char* const comma = p;
      const char* const next = skip_space(p + 1, end_);
      if (starts_number(*next)) {
        p = next;
        continue;
      }
      if (*next != ']') break;
      warn(SyntaxError::trailing_comma, span(comma, comma + 1), "trailing comma");
      p = next;
    } else if (starts_number(*p)) {
      warn(SyntaxError::missing_comma, token_at(text(), offset(p)), "missing ',' before this item");
      continue;
    }
    if (*p != ']') break;
    nodes_[array].kind = Kind::number_array;
    nodes_[array].numbers = static_cast<std::uint8_t>(std::min<unsigned>(numbers, kManyNumbers));
    return close(p);
  }
  expand_number_array(array, p);
  return p;
}

void Parser::expand_number_array(NodeId array, const char* end) {
  const char* p = begin_ + nodes_[array].begin + 1;
  for (;;) {
    while (is_a(kSpace, *p) || *p == ',') ++p;
    if (p >= end) return;
    const char* const behind = scan_number(p, end_).end;
    add(Kind::number, p, behind);
    ++frames_.back().elements;
    p = behind;
  }
}

void Parser::open(NodeId node, bool is_object) {
  const KeyId owner = frames_.empty() ? kNoKey : frames_.back().key;
  frames_.push_back({node, owner, 2 * (owner + 1) + 1, is_object});
}

const char* Parser::close(const char* p) {
  const Frame frame = frames_.back();
  frames_.pop_back();
  nodes_[frame.node].end = offset(p + 1);
  nodes_[frame.node].next = static_cast<NodeId>(nodes_.size());
  if (frame.is_object) {
    end_members(frame.node);
  } else if (frame.elements >= Document::kManyElements) {
    document_.large_arrays_.push_back({frame.node, frame.elements});
  }
  return p + 1;
}

}  // namespace gltfx::json
