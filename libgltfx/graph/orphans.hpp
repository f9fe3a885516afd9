// SPDX-License-Identifier: Apache-2.0
/// Elements of root arrays that lose their last reference when objects are removed.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "graph/graph.hpp"

namespace gltfx::graph {

/// Counts the remaining references while objects are removed. References of an element to itself do
/// not count. The graph must outlive it.
class Orphans {
 public:
  explicit Orphans(const Graph& graph);

  bool is_used(json::NodeId element) const;
  /// Removes an object. Returns it and the elements that only it and earlier removed objects refer
  /// to. Linear in these. Precondition: it was not removed before.
  std::vector<json::NodeId> take(json::NodeId object);

 private:
  json::NodeId element_of(const Use& use) const;

  const Graph& graph_;
  std::unordered_map<json::NodeId, std::uint64_t> left_;  ///< by element
};

/// The `candidates`, sorted elements of root arrays, without references except from each other.
std::vector<json::NodeId> find_orphans(const Graph& graph,
                                       const std::vector<json::NodeId>& candidates);

}  // namespace gltfx::graph
