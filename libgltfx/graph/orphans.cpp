// SPDX-License-Identifier: Apache-2.0
#include "graph/orphans.hpp"

#include <algorithm>
#include <iterator>

namespace gltfx::graph {

Orphans::Orphans(const Graph& graph) : graph_(graph) {
  for (const Use& use : graph.uses()) {
    const json::NodeId element = element_of(use);
    if (element != json::kNoNode) ++left_[element];
  }
}

// The element that a reference from outside it leads to or into, or kNoNode.
json::NodeId Orphans::element_of(const Use& use) const {
  const json::NodeId element = graph_.tree().root_element(use.target);
  return element == graph_.tree().root_element(use.at.node) ? json::kNoNode : element;
}

bool Orphans::is_used(json::NodeId element) const {
  const auto left = left_.find(element);
  return left != left_.end() && left->second > 0;
}

std::vector<json::NodeId> Orphans::take(json::NodeId object) {
  std::vector<json::NodeId> gone{object};
  for (std::size_t i = 0; i < gone.size(); ++i) {
    graph_.each_use_in(gone[i], [&](const Use& use) {
      const json::NodeId element = element_of(use);
      if (element != json::kNoNode && --left_[element] == 0) gone.push_back(element);
    });
  }
  return gone;
}

std::vector<json::NodeId> find_orphans(const Graph& graph,
                                       const std::vector<json::NodeId>& candidates) {
  Orphans orphans(graph);
  std::vector<json::NodeId> unused, found;
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(unused),
               [&](json::NodeId each) { return !orphans.is_used(each); });
  for (const json::NodeId each : unused) {
    for (const json::NodeId gone : orphans.take(each)) {
      if (std::binary_search(candidates.begin(), candidates.end(), gone)) found.push_back(gone);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace gltfx::graph
