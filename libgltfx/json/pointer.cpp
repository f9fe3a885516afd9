// SPDX-License-Identifier: Apache-2.0
/// JSON pointers to nodes and back.
#include <charconv>

#include "base/json_pointer.hpp"
#include "json/document.hpp"

namespace gltfx::json {
namespace {

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
  for (const Members::Member& member : document.members(at)) {
    if (id >= document.next(member.value)) continue;
    append_pointer_step(pointer, document.key(member.key_id));
    return id == member.key ? id : member.value;
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
