// SPDX-License-Identifier: Apache-2.0
#include "graph/tree.hpp"

#include <algorithm>
#include <charconv>

#include "base/json_pointer.hpp"

namespace gltfx::graph {
namespace {

std::uint64_t member_key(json::NodeId object, json::KeyId name) {
  return (std::uint64_t{object} << 32U) | name;
}

// An index as in RFC 6901 section 4: digits without leading zeros.
std::optional<std::uint64_t> index_of(std::string_view step) {
  std::uint64_t index = 0;
  const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
  const bool whole = error == std::errc() && end == step.data() + step.size();
  if (!whole || (step.size() > 1 && step.front() == '0')) return std::nullopt;
  return index;
}

}  // namespace

Tree::Tree(const json::Document& document)
    : document_(document),
      parents_(document.node_count(), json::kNoNode),
      positions_(document.node_count(), 0),
      sizes_(document.node_count(), 0) {
  std::vector<json::NodeId> open;
  for (json::NodeId id = 0; id < document.node_count(); ++id) {
    while (!open.empty() && document.next(open.back()) <= id) open.pop_back();
    const json::Kind kind = document.kind(id);
    if (!open.empty()) {
      parents_[id] = open.back();
      if (kind != json::Kind::key) positions_[id] = sizes_[open.back()]++;
    }
    if (kind == json::Kind::object || kind == json::Kind::array) open.push_back(id);
  }
}

json::NodeId Tree::root_element(json::NodeId value) const {
  json::NodeId array = json::kNoNode, element = json::kNoNode;
  for (json::NodeId at = value; at != json::kNoNode && at != document_.root(); at = parents_[at]) {
    element = array;
    array = at;
  }
  const bool found = element != json::kNoNode && document_.is_array(array);
  return found ? element : json::kNoNode;
}

std::uint64_t Tree::size(json::NodeId container) const {
  const bool numbers_only = document_.kind(container) == json::Kind::number_array;
  return numbers_only ? numbers(container).size() : sizes_[container];
}

const std::vector<std::uint32_t>& Tree::numbers(json::NodeId array) const {
  const auto [known, is_new] = numbers_.try_emplace(array);
  if (!is_new) return known->second;
  for (json::NumberCursor at(document_, array); at.valid(); at.advance()) {
    known->second.push_back(at.number().span.begin);
  }
  return known->second;
}

std::uint64_t Tree::number_at(json::NodeId array, std::uint32_t begin) const {
  const std::vector<std::uint32_t>& all = numbers(array);
  return static_cast<std::uint64_t>(std::lower_bound(all.begin(), all.end(), begin) - all.begin());
}

const std::vector<json::NodeId>& Tree::elements(json::NodeId array) const {
  const auto [known, is_new] = elements_.try_emplace(array);
  if (is_new && document_.kind(array) == json::Kind::array) {
    for (const json::NodeId element : document_.elements(array)) known->second.push_back(element);
  }
  return known->second;
}

json::NodeId Tree::element(json::NodeId array, std::uint64_t index) const {
  const std::vector<json::NodeId>& all = elements(array);
  return index < all.size() ? all[index] : json::kNoNode;
}

json::NodeId Tree::member(json::NodeId object, std::string_view name) const {
  const json::KeyId key = document_.key_id(name);
  if (key == json::kNoKey) return json::kNoNode;
  if (known_objects_.insert(object).second) {
    for (const auto each : document_.members(object)) {
      members_[member_key(object, each.key_id)] = each.value;
    }
  }
  const auto found = members_.find(member_key(object, key));
  return found == members_.end() ? json::kNoNode : found->second;
}

Place Tree::step(json::NodeId from, std::string_view name) const {
  if (document_.is_object(from)) return {member(from, name), std::nullopt};
  const auto index = index_of(name);
  if (!index || !document_.is_array(from)) return {};
  if (document_.kind(from) == json::Kind::array) return {element(from, *index), std::nullopt};
  return *index < size(from) ? Place{from, index} : Place{};
}

Place Tree::find(std::string_view pointer) const {
  const auto steps = split_pointer(pointer);
  if (!steps) return {};
  Place place{document_.root(), std::nullopt};
  for (const std::string& name : *steps) {
    if (place.element) return {};
    place = step(place.node, name);
    if (place.node == json::kNoNode) return {};
  }
  return place;
}

std::string Tree::pointer(Place place) const {
  std::vector<json::NodeId> path;
  for (json::NodeId at = place.node; parents_[at] != json::kNoNode; at = parents_[at]) {
    path.push_back(at);
  }
  std::string text;
  for (auto at = path.rbegin(); at != path.rend(); ++at) {
    append_pointer_step(text, is_member(*at) ? name(*at) : std::to_string(positions_[*at]));
  }
  if (place.element) append_pointer_step(text, std::to_string(*place.element));
  return text;
}

}  // namespace gltfx::graph
