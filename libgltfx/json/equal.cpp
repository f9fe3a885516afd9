// SPDX-License-Identifier: Apache-2.0
#include "json/equal.hpp"

#include <unordered_map>
#include <utility>
#include <vector>

namespace gltfx::json {
namespace {

using Pairs = std::vector<std::pair<NodeId, NodeId>>;

std::unordered_map<KeyId, NodeId> members_by_key(const Document& document, NodeId object) {
  std::unordered_map<KeyId, NodeId> members;
  for (const auto member : document.members(object)) members[member.key_id] = member.value;
  return members;
}

// What is left to compare is added to `pairs`.
bool same_members(const Document& document, NodeId one, NodeId other, Pairs& pairs) {
  const auto ours = members_by_key(document, one);
  const auto theirs = members_by_key(document, other);
  if (ours.size() != theirs.size()) return false;
  for (const auto& [key, value] : ours) {
    const auto found = theirs.find(key);
    if (found == theirs.end()) return false;
    pairs.emplace_back(value, found->second);
  }
  return true;
}

bool same_elements(const Document& document, NodeId one, NodeId other, Pairs& pairs) {
  if (document.array_size(one) != document.array_size(other)) return false;
  const auto theirs = document.elements(other);
  auto next = theirs.begin();
  for (const NodeId element : document.elements(one)) {
    pairs.emplace_back(element, *next);
    ++next;
  }
  return true;
}

bool same_numbers(const Document& document, NodeId one, NodeId other) {
  NumberCursor ours(document, one);
  NumberCursor theirs(document, other);
  for (; ours.valid() && theirs.valid(); ours.advance(), theirs.advance()) {
    if (ours.number().value != theirs.number().value) return false;
  }
  return !ours.valid() && !theirs.valid();
}

}  // namespace

bool equal(const Document& document, NodeId one, NodeId other) {
  Pairs pairs{{one, other}};
  while (!pairs.empty()) {
    const auto [ours, theirs] = pairs.back();
    pairs.pop_back();
    if (document.kind(ours) != document.kind(theirs)) return false;
    bool same = true;
    if (document.is_object(ours)) {
      same = same_members(document, ours, theirs, pairs);
    } else if (document.kind(ours) == Kind::number_array) {
      same = same_numbers(document, ours, theirs);
    } else if (document.is_array(ours)) {
      same = same_elements(document, ours, theirs, pairs);
    } else if (document.is_number(ours)) {
      same = document.number(ours).value == document.number(theirs).value;
    } else if (document.is_string(ours)) {
      same = document.string(ours) == document.string(theirs);
    }
    if (!same) return false;
  }
  return true;
}

}  // namespace gltfx::json
