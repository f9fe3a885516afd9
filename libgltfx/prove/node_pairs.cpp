// SPDX-License-Identifier: Apache-2.0
#include "prove/node_pairs.hpp"

#include <algorithm>

#include "model/scene_graph.hpp"

namespace gltfx::prove {
namespace {

using model::RootArray;

// The nodes in a list of indices.
std::vector<json::NodeId> listed(const Side& side, json::NodeId owner, std::string_view member) {
  std::vector<json::NodeId> nodes;
  const auto& all = side.asset().elements(RootArray::nodes);
  model::for_each_index(side.asset(), side.document().find(owner, member), RootArray::nodes,
                        [&](std::uint64_t, const std::optional<std::uint32_t>& index, Span) {
                          nodes.push_back(index ? all[*index] : json::kNoNode);
                        });
  return nodes;
}

// Nodes without a parent.
std::vector<json::NodeId> roots(const Side& side) {
  const model::SceneGraph graph(side.asset(), side.views().nodes);
  const auto& all = side.asset().elements(RootArray::nodes);
  std::vector<json::NodeId> nodes;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (graph.is_root(static_cast<model::NodeIndex>(i))) nodes.push_back(all[i]);
  }
  return nodes;
}

}  // namespace

NodePairs::NodePairs(const Side& before, const Side& after) : before_(before), after_(after) {
  const auto& here = before.asset().elements(RootArray::scenes);
  const auto& there = after.asset().elements(RootArray::scenes);
  for (std::size_t i = 0; i < std::min(here.size(), there.size()); ++i) {
    if (here[i] == json::kNoNode || there[i] == json::kNoNode) continue;
    add_lists(listed(before, here[i], "nodes"), listed(after, there[i], "nodes"));
  }
  const auto unpaired = [](std::vector<json::NodeId> nodes, const auto& paired) {
    std::erase_if(nodes, [&](json::NodeId node) { return paired.contains(node); });
    return nodes;
  };
  add_lists(unpaired(roots(before), theirs_), unpaired(roots(after), ours_));
  add_lists(unpaired(before.asset().elements(RootArray::nodes), theirs_),
            unpaired(after.asset().elements(RootArray::nodes), ours_));
}

void NodePairs::add(json::NodeId ours, json::NodeId theirs) {
  if (ours == json::kNoNode || theirs == json::kNoNode) return;
  if (theirs_.contains(ours) || ours_.contains(theirs)) return;
  theirs_.emplace(ours, theirs);
  ours_.emplace(theirs, ours);
  pairs_.push_back({ours, theirs});
}

void NodePairs::add_lists(const std::vector<json::NodeId>& ours,
                          const std::vector<json::NodeId>& theirs) {
  for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i) {
    add(ours[i], theirs[i]);
    add_children();
  }
}

void NodePairs::add_children() {
  for (; done_ < pairs_.size(); ++done_) {
    const auto [ours, theirs] = pairs_[done_];
    const std::vector<json::NodeId> here = listed(before_, ours, "children");
    const std::vector<json::NodeId> there = listed(after_, theirs, "children");
    for (std::size_t i = 0; i < std::min(here.size(), there.size()); ++i) add(here[i], there[i]);
  }
}

}  // namespace gltfx::prove
