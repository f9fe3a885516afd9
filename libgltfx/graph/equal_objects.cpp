// SPDX-License-Identifier: Apache-2.0
#include "graph/equal_objects.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace gltfx::graph {
namespace {

using json::NodeId;

constexpr std::uint64_t kNoElement = UINT64_MAX;

}  // namespace

EqualObjects::EqualObjects(const Graph& graph) : document_(graph.tree().document()) {
  for (const IndexUse& use : graph.indices()) {
    const bool leads = use.list != json::kNoNode && document_.is_array(use.list);
    const NodeId target = leads ? graph.tree().element(use.list, use.index) : json::kNoNode;
    if (target == json::kNoNode) continue;
    targets_.push_back({{use.at.node, use.at.element.value_or(kNoElement)}, target});
  }
  std::sort(targets_.begin(), targets_.end());
}

void EqualObjects::describe_number(const json::Number& number, Place place, std::string& to) const {
  const auto target =
      std::lower_bound(targets_.begin(), targets_.end(), place,
                       [](const auto& one, Place wanted) { return one.first < wanted; });
  if (target != targets_.end() && target->first == place) {
    to += fmt::format("#{}", first(target->second));
  } else if (number.is_integer() && number.value != 0) {
    to += fmt::format("{}", static_cast<std::int64_t>(number.value));
  } else {
    to += number.span.in(document_.text());
  }
}

void EqualObjects::describe(NodeId value, const std::function<bool(NodeId)>& is_left_out,
                            std::string& to) const {
  switch (document_.kind(value)) {
    case json::Kind::number:
      return describe_number(document_.number(value), {value, kNoElement}, to);
    case json::Kind::number_array: {
      std::uint64_t position = 0;
      to += '[';
      for (json::NumberCursor at(document_, value); at.valid(); at.advance()) {
        describe_number(at.number(), {value, position++}, to);
        to += ',';
      }
      to += ']';
      return;
    }
    case json::Kind::array:
      to += '[';
      for (const NodeId element : document_.elements(value)) {
        describe(element, is_left_out, to);
        to += ',';
      }
      to += ']';
      return;
    case json::Kind::object: {
      std::vector<std::pair<std::string_view, NodeId>> members;
      for (const auto member : document_.members(value)) {
        if (is_left_out && is_left_out(member.value)) continue;
        members.emplace_back(document_.key(member.key_id), member.value);
      }
      std::sort(members.begin(), members.end());
      to += '{';
      for (const auto& [name, content] : members) {
        to += fmt::format("{}:{}:", name.size(), name);
        describe(content, is_left_out, to);
        to += ',';
      }
      to += '}';
      return;
    }
    default:
      to += document_.raw(value);
  }
}

std::vector<std::pair<NodeId, NodeId>> ContentGroups::find(const Hash& hash,
                                                           const IsEqual& is_equal) const {
  std::vector<std::pair<NodeId, NodeId>> found;
  for (const auto& [description, elements] : groups_) {
    if (elements.size() < 2) continue;
    std::map<std::string, NodeId> firsts;
    for (const NodeId element : elements) {
      auto content = hash(element);
      if (!content) continue;
      const auto [first, is_new] = firsts.try_emplace(*std::move(content), element);
      if (!is_new && is_equal(first->second, element)) found.emplace_back(element, first->second);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::pair<NodeId, NodeId>> ContentGroups::find() const {
  return find([](NodeId) { return std::string(); }, [](NodeId, NodeId) { return true; });
}

}  // namespace gltfx::graph
