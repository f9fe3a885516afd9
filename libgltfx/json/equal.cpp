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

// All half surrogates are read as U+FFFD, so such texts can differ although they read alike.
bool is_certain(std::string_view unescaped) {
  constexpr std::string_view kReplacement = "\uFFFD";
  return unescaped.find(kReplacement) == unescaped.npos;
}

/// Two documents, which may be one.
struct Sides {
  const Document& ours;
  const Document& theirs;
  bool by_value;  ///< numbers are

  bool same_string(NodeId one, NodeId other) const {
    if (ours.raw(one) == theirs.raw(other)) return true;
    const std::string content = ours.string(one);
    return content == theirs.string(other) && is_certain(content);
  }
  bool same(const Number& one, const Number& other) const {
    return by_value ? one.value == other.value
                    : same_number(ours.text(), one, theirs.text(), other);
  }
  // What is left to compare is added to `pairs`.
  bool same_members(NodeId one, NodeId other, Pairs& pairs) const;
  bool same_elements(NodeId one, NodeId other, Pairs& pairs) const;
  bool same_numbers(NodeId one, NodeId other) const;
  bool equal(NodeId one, NodeId other) const;
};

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

// By their keys in `names`; a key that it does not have has kNoKey, as only one member can have
// where all are found.
std::unordered_map<KeyId, NodeId> members_by_key(const Document& document, NodeId object,
                                                 const Document& names) {
  const bool own = &document == &names;
  std::unordered_map<KeyId, NodeId> members;
  for (const auto member : document.members(object)) {
    members[own ? member.key_id : names.key_id(document.key(member.key_id))] = member.value;
  }
  return members;
}

bool Sides::same_members(NodeId one, NodeId other, Pairs& pairs) const {
  const auto here = members_by_key(ours, one, ours);
  const auto there = members_by_key(theirs, other, ours);
  if (here.size() != there.size()) return false;
  for (const auto& [key, value] : here) {
    const auto found = there.find(key);
    if (found == there.end() || !is_certain(ours.key(key))) return false;
    pairs.emplace_back(value, found->second);
  }
  return true;
}

bool Sides::same_elements(NodeId one, NodeId other, Pairs& pairs) const {
  if (ours.array_size(one) != theirs.array_size(other)) return false;
  const auto there = theirs.elements(other);
  auto next = there.begin();
  for (const NodeId element : ours.elements(one)) {
    pairs.emplace_back(element, *next);
    ++next;
  }
  return true;
}

bool Sides::same_numbers(NodeId one, NodeId other) const {
  NumberCursor here(ours, one);
  NumberCursor there(theirs, other);
  for (; here.valid() && there.valid(); here.advance(), there.advance()) {
    if (!same(here.number(), there.number())) return false;
  }
  return !here.valid() && !there.valid();
}

bool Sides::equal(NodeId one, NodeId other) const {
  Pairs pairs{{one, other}};
  while (!pairs.empty()) {
    const auto [here, there] = pairs.back();
    pairs.pop_back();
    if (ours.kind(here) != theirs.kind(there)) return false;
    bool alike = true;
    if (ours.is_object(here)) {
      alike = same_members(here, there, pairs);
    } else if (ours.kind(here) == Kind::number_array) {
      alike = same_numbers(here, there);
    } else if (ours.is_array(here)) {
      alike = same_elements(here, there, pairs);
    } else if (ours.is_number(here)) {
      alike = same(ours.number(here), theirs.number(there));
    } else if (ours.is_string(here) || ours.kind(here) == Kind::key) {
      alike = same_string(here, there);
    }
    if (!alike) return false;
  }
  return true;
}

}  // namespace

bool same_number(std::string_view our_text, const Number& one, std::string_view their_text,
                 const Number& other) {
  if (one.span.in(our_text) == other.span.in(their_text)) return true;
  return one.value == other.value && std::signbit(one.value) == std::signbit(other.value) &&
         is_told_apart(one, our_text) && is_told_apart(other, their_text);
}

bool equal(const Document& document, NodeId one, NodeId other) {
  return equal(document, one, document, other);
}

bool equal(const Document& ours, NodeId one, const Document& theirs, NodeId other) {
  return Sides{ours, theirs, false}.equal(one, other);
}

bool equal_by_value(const Document& ours, NodeId one, const Document& theirs, NodeId other) {
  return Sides{ours, theirs, true}.equal(one, other);
}

}  // namespace gltfx::json
