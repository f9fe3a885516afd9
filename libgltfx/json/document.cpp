// SPDX-License-Identifier: Apache-2.0
#include "json/document.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "base/json_pointer.hpp"
#include "json/literals.hpp"
#include "json/scan.hpp"

namespace gltfx::json {
namespace {

constexpr double kLargestExact = 9007199254740992.0;  // 2^53

bool separates_numbers(char c) { return c == ',' || is_a(kSpace, c); }

// The index a pointer's step names: decimal, without leading zeros (RFC 6901 section 4).
std::optional<std::uint64_t> array_index(std::string_view step) {
  std::uint64_t index = 0;
  if (step.empty() || (step.size() > 1 && step.front() == '0')) return std::nullopt;
  const char* const end = step.data() + step.size();
  const auto read = std::from_chars(step.data(), end, index);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return index;
}

NodeId element_at(const Document& document, NodeId array, std::uint64_t index) {
  for (const NodeId element : document.elements(array)) {
    if (index-- == 0) return element;
  }
  return kNoNode;
}

NodeId step_into(const Document& document, NodeId at, const std::string& step) {
  if (document.is_object(at)) return document.find(at, step);
  const auto index = array_index(step);
  return index ? element_at(document, at, *index) : kNoNode;
}

// The child of `at` that is `id` or holds it, with its step appended to `pointer`.
NodeId descend(const Document& document, NodeId at, NodeId id, std::string& pointer) {
  if (document.is_object(at)) {
    // Hidden members are in the text, too.
    NodeId key = at + 1;
    while (document.next(key + 1) <= id) key = document.next(key + 1);
    append_pointer_step(pointer, document.key(document.node(key).next));
    return id == key ? id : key + 1;
  }
  std::uint64_t index = 0;
  for (const NodeId element : document.elements(at)) {
    if (id < document.next(element)) {
      pointer += '/' + std::to_string(index);
      return element;
    }
    ++index;
  }
  return id;
}

}  // namespace

bool Number::is_integer() const {
  return std::fabs(value) <= kLargestExact && value == std::trunc(value);
}

Members::Member Members::Iterator::operator*() const {
  return {at_, at_ + 1, document_->node(at_).next};
}

void Members::Iterator::skip_hidden() {
  while (at_ != end_ && document_->node(at_).hidden) at_ = document_->next(at_ + 1);
}

Members::Iterator& Members::Iterator::operator++() {
  at_ = document_->next(at_ + 1);
  skip_hidden();
  return *this;
}

Members::Iterator Members::begin() const {
  const NodeId last = end().at_;
  Iterator first(*document_, document_->node(object_).hidden ? last : object_ + 1, last);
  first.skip_hidden();
  return first;
}

Members::Iterator Members::end() const {
  const bool has_members = document_->is_object(object_);
  const NodeId last = has_members ? document_->next(object_) : object_ + 1;
  return {*document_, last, last};
}

NumberCursor::NumberCursor(const Document& document, NodeId number_array)
    : text_(document.text()),
      at_(document.node(number_array).begin + 1),
      end_(document.node(number_array).end - 1) {
  read();
}

void NumberCursor::advance() {
  at_ = number_.span.end;
  read();
}

void NumberCursor::read() {
  while (at_ < end_ && separates_numbers(text_[at_])) ++at_;
  valid_ = at_ < end_;
  if (!valid_) return;
  const LeadingNumber number = read_leading_number(text_.substr(at_, end_ - at_));
  number_ = {{at_, at_ + static_cast<std::uint32_t>(number.size)}, number.value};
}

std::size_t Document::array_size(NodeId array) const {
  std::size_t size = 0;
  if (kind(array) != Kind::number_array) {
    if (next(array) - array > kManyElements) {
      const auto large = std::lower_bound(
          large_arrays_.begin(), large_arrays_.end(), array,
          [](const LargeArray& each, NodeId wanted) { return each.array < wanted; });
      if (large != large_arrays_.end() && large->array == array) return large->size;
    }
    for ([[maybe_unused]] const NodeId element : elements(array)) ++size;
    return size;
  }
  if (node(array).numbers < kManyNumbers) return node(array).numbers;
  bool in_number = false;
  for (const char c : raw(array)) {
    const bool word = is_a(kWord, c);
    size += word && !in_number ? 1 : 0;
    in_number = word;
  }
  return size;
}

std::size_t Document::object_size(NodeId object) const {
  std::size_t size = 0;
  for ([[maybe_unused]] const Members::Member& member : members(object)) ++size;
  return size;
}

NodeId Document::find(NodeId object, std::string_view name) const {
  if (object == kNoNode || !is_object(object)) return kNoNode;
  const Node* const nodes = nodes_.data();
  if (nodes[object].hidden) return kNoNode;
  // Most objects are small: comparing names costs less than hashing the name.
  std::uint32_t left = kFewMembers;
  const NodeId end = nodes[object].next;
  NodeId found = kNoNode;
  for (NodeId key = object + 1; key < end; key = nodes[key + 1].next) {
    if (left-- == 0) {
      const KeyId id = key_id(name);
      return id == kNoKey ? kNoNode : find(object, id);
    }
    if (is_same(keys_.name(nodes[key].next), name)) found = key + 1;
  }
  return found != kNoNode && nodes[found - 1].hidden ? kNoNode : found;
}

NodeId Document::find(NodeId object, KeyId name) const {
  if (object == kNoNode || !is_object(object)) return kNoNode;
  if (nodes_[object].hidden) return kNoNode;
  const NodeId found = last_member(object, name);
  return found != kNoNode && nodes_[found - 1].hidden ? kNoNode : found;
}

NodeId Document::find_in_text(NodeId object, std::string_view name) const {
  if (object == kNoNode || !is_object(object) || nodes_[object].hidden) return kNoNode;
  return last_member(object, key_id(name));
}

// The most frequently called function: it does not use the iterator, which is in another file.
NodeId Document::last_member(NodeId object, KeyId name) const {
  const Node* const nodes = nodes_.data();
  const NodeId end = nodes[object].next;
  if (end - object > 2 * kManyMembers) {
    const auto large = std::lower_bound(
        large_objects_.begin(), large_objects_.end(), object,
        [](const LargeObject& each, NodeId wanted) { return each.object < wanted; });
    if (large != large_objects_.end() && large->object == object) {
      const auto first = sorted_values_.begin() + large->begin;
      const auto behind =
          std::upper_bound(first, sorted_values_.begin() + large->end, name,
                           [this](KeyId wanted, NodeId value) { return wanted < key_of(value); });
      const bool is_there = behind != first && key_of(*(behind - 1)) == name;
      return is_there ? *(behind - 1) : kNoNode;
    }
  }
  NodeId found = kNoNode;
  for (NodeId key = object + 1; key < end; key = nodes[key + 1].next) {
    if (nodes[key].next == name) found = key + 1;
  }
  return found;
}

void Document::sort_members(NodeId object) {
  const auto begin = static_cast<std::uint32_t>(sorted_values_.size());
  const NodeId end = nodes_[object].next;
  for (NodeId key = object + 1; key < end; key = nodes_[key + 1].next) {
    sorted_values_.push_back(key + 1);
  }
  const auto by_key = [this](NodeId one, NodeId other) {
    return std::pair(key_of(one), one) < std::pair(key_of(other), other);
  };
  const auto first = sorted_values_.begin() + begin;
  if (!std::is_sorted(first, sorted_values_.end(), by_key)) {
    std::sort(first, sorted_values_.end(), by_key);
  }
  large_objects_.push_back({object, begin, static_cast<std::uint32_t>(sorted_values_.size())});
}

void Document::sort_large() {
  // They are added in the order in which they end.
  std::sort(large_arrays_.begin(), large_arrays_.end(),
            [](const LargeArray& a, const LargeArray& b) { return a.array < b.array; });
  std::sort(large_objects_.begin(), large_objects_.end(),
            [](const LargeObject& a, const LargeObject& b) { return a.object < b.object; });
}

bool Document::has_value(NodeId object, std::string_view name) const {
  const NodeId value = find_in_text(object, name);
  return value != kNoNode && !(is_hidden(value) && kind(value) == Kind::null);
}

Number Document::number(NodeId id) const { return {span(id), number_value(raw(id))}; }

std::optional<std::uint64_t> Document::unsigned_integer(NodeId id) const {
  if (id == kNoNode || !is_number(id)) return std::nullopt;
  const Number read = number(id);
  if (!read.is_integer() || read.value < 0) return std::nullopt;
  return static_cast<std::uint64_t>(read.value);
}

std::string Document::string(NodeId id) const {
  std::string buffer;
  return std::string(string(id, buffer));
}

std::string_view Document::string(NodeId id, std::string& buffer) const {
  const Node& read = node(id);
  const std::string_view content = Span{read.begin + 1, read.end - 1}.in(text());
  if (!read.escaped) return content;
  buffer.clear();
  append_unescaped(buffer, content);
  return buffer;
}

bool Document::insert_string(NodeId id, KeyTable& table) const {
  std::string unescaped;
  const std::string_view content = string(id, unescaped);
  return unescaped.empty() ? table.insert(content) : table.insert_copy(std::move(unescaped));
}

std::string Document::pointer_of(NodeId id) const {
  std::string pointer;
  for (NodeId at = root(); at != id;) at = descend(*this, at, id, pointer);
  return pointer;
}

NodeId Document::resolve(std::string_view pointer, std::optional<std::uint64_t>* element) const {
  if (element != nullptr) element->reset();
  const auto steps = split_pointer(pointer);
  if (!steps || empty()) return kNoNode;
  NodeId at = root();
  for (std::size_t i = 0; i < steps->size() && at != kNoNode; ++i) {
    if (kind(at) != Kind::number_array) {
      at = step_into(*this, at, (*steps)[i]);
      continue;
    }
    const auto index = array_index((*steps)[i]);
    if (i + 1 != steps->size() || !index || *index >= array_size(at)) return kNoNode;
    if (element != nullptr) *element = *index;
  }
  return at;
}

}  // namespace gltfx::json
