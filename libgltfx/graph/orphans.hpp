// SPDX-License-Identifier: Apache-2.0
/// Elements of root arrays that lose their last reference when objects go.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "graph/graph.hpp"

namespace gltfx::graph {

/// Counts the references that are left while objects go. References of an element to itself do not
/// count. The graph must outlive it.
class Orphans {
 public:
  explicit Orphans(const Graph& graph);

  bool is_used(json::NodeId element) const;
  /// An object that goes, and the elements to which only it and what went before it refer. Linear
  /// in these. Precondition: it has not gone before.
  std::vector<json::NodeId> take(json::NodeId object);

 private:
  json::NodeId element_of(const Use& use) const;

  const Graph& graph_;
  std::unordered_map<json::NodeId, std::uint64_t> left_;  ///< by element
};

/// Those of `candidates`, sorted elements of root arrays, to which nothing refers but others of
/// them that are found.
std::vector<json::NodeId> find_orphans(const Graph& graph,
                                       const std::vector<json::NodeId>& candidates);

}  // namespace gltfx::graph
