// SPDX-License-Identifier: Apache-2.0
/// Parents of nodes (specification section 3.5.1). A file may hold loops and nodes with several
/// parents; everything here is defined for those, too, and nothing recurses.
#pragma once

#include <cstdint>
#include <vector>

#include "base/span.hpp"
#include "model/node.hpp"

namespace gltfx::model {

/// A node that is listed as a child although it already has a parent.
struct ParentOverride {
  NodeIndex parent = kNoNodeIndex;  ///< the node whose `children` lists it again
  NodeIndex child = kNoNodeIndex;
  NodeIndex previous = kNoNodeIndex;  ///< the previous parent; may be the same node
  std::uint64_t position = 0;         ///< in `children` of `parent`
  Span span;                          ///< of that element
};

/// The forest of an asset. If a node has several parents, the last one in the order of the file
/// counts. Linear to build, then read-only; any number of threads may read it.
class SceneGraph {
 public:
  SceneGraph() = default;
  SceneGraph(const Asset& asset, const std::vector<Node>& nodes);

  std::size_t size() const { return parents_.size(); }
  /// kNoNodeIndex for a root.
  NodeIndex parent(NodeIndex node) const { return parents_[node]; }
  bool is_root(NodeIndex node) const { return parents_[node] == kNoNodeIndex; }
  /// Whether the node is part of a loop of parents; nodes below a loop are not.
  bool on_loop(NodeIndex node) const { return on_loop_[node] != 0; }
  /// The representative of the node's tree: its root, or one node of the loop above it.
  NodeIndex component(NodeIndex node) const { return components_[node]; }
  /// The root above the node, or the node itself if it is a root; kNoNodeIndex below a loop or on
  /// one.
  NodeIndex root(NodeIndex node) const {
    const NodeIndex top = components_[node];
    return on_loop(top) ? kNoNodeIndex : top;
  }
  /// In the order of the file.
  const std::vector<ParentOverride>& overrides() const { return overrides_; }

 private:
  void read_children(const Asset& asset, const std::vector<Node>& nodes);
  void find_components();
  void climb(NodeIndex start, std::vector<NodeIndex>& way, std::vector<std::uint8_t>& state);

  std::vector<NodeIndex> parents_;
  std::vector<NodeIndex> components_;
  std::vector<std::uint8_t> on_loop_;
  std::vector<ParentOverride> overrides_;
};

/// Answers in constant time whether one node is above another: the interval of an Euler tour.
class Ancestry {
 public:
  /// Linear in the graph, of which it keeps no reference.
  explicit Ancestry(const SceneGraph& graph);

  /// False for nodes on or below a loop.
  bool is_ancestor_or_self(NodeIndex upper, NodeIndex lower) const {
    return enter_[upper] != 0 && enter_[upper] <= enter_[lower] && enter_[lower] <= last_[upper];
  }

 private:
  std::vector<std::uint32_t> enter_;  ///< from 1; 0: not in a tree
  std::vector<std::uint32_t> last_;   ///< greatest `enter_` below a node
};

}  // namespace gltfx::model
