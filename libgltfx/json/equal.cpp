// SPDX-License-Identifier: Apache-2.0
#include "json/equal.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
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

// All half surrogates are read as U+FFFD, so such texts can differ although they read alike.
bool is_certain(std::string_view unescaped) {
  constexpr std::string_view kReplacement = "\uFFFD";
  return unescaped.find(kReplacement) == unescaped.npos;
}

bool same_string(const Document& document, NodeId one, NodeId other) {
  if (document.raw(one) == document.raw(other)) return true;
  const std::string content = document.string(one);
  return content == document.string(other) && is_certain(content);
}

// Up to 15 digits, no two numbers have the same nearest double.
bool is_told_apart(const Number& number, std::string_view text) {
  constexpr std::ptrdiff_t kDigits = 15;
  const std::string_view literal = number.span.in(text);
  const std::string_view digits = literal.substr(0, literal.find_first_of("eE"));
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (number.value == 0) return digits.find_first_of("123456789") == digits.npos;
  return std::isnormal(number.value) &&
         std::count_if(digits.begin(), digits.end(), is_digit) <= kDigits;
}

bool same_number(const Document& document, const Number& one, const Number& other) {
  const std::string_view text = document.text();
  if (one.span.in(text) == other.span.in(text)) return true;
  return one.value == other.value && std::signbit(one.value) == std::signbit(other.value) &&
         is_told_apart(one, text) && is_told_apart(other, text);
}

// What is left to compare is added to `pairs`.
bool same_members(const Document& document, NodeId one, NodeId other, Pairs& pairs) {
  const auto ours = members_by_key(document, one);
  const auto theirs = members_by_key(document, other);
  if (ours.size() != theirs.size()) return false;
  for (const auto& [key, value] : ours) {
    const auto found = theirs.find(key);
    if (found == theirs.end() || !is_certain(document.key(key))) return false;
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
    if (!same_number(document, ours.number(), theirs.number())) return false;
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
      same = same_number(document, document.number(ours), document.number(theirs));
    } else if (document.is_string(ours) || document.kind(ours) == Kind::key) {
      same = same_string(document, ours, theirs);
    }
    if (!same) return false;
  }
  return true;
}

}  // namespace gltfx::json
