// SPDX-License-Identifier: Apache-2.0
/// Corresponding nodes of two assets: by their places in the scenes, not by number.
#pragma once

#include <unordered_map>
#include <vector>

#include "prove/side.hpp"

namespace gltfx::prove {

/// A one-to-one relation. Nodes are identified by place: two equal nodes are not the same.
class NodePairs {
 public:
  /// Roots of scenes in order, then roots outside of scenes, then the other nodes, each with its
  /// children in order. Iterative; linear.
  NodePairs(const Side& before, const Side& after);

  const std::vector<Pair>& all() const { return pairs_; }
  /// Whether a node of `after` corresponds to one of `before`.
  bool has_theirs(json::NodeId theirs) const { return ours_.contains(theirs); }
  bool matches(json::NodeId ours, json::NodeId theirs) const {
    const auto found = theirs_.find(ours);
    return found != theirs_.end() && found->second == theirs;
  }

 private:
  void add(json::NodeId ours, json::NodeId theirs);
  void add_lists(const std::vector<json::NodeId>& ours, const std::vector<json::NodeId>& theirs);
  void add_children();

  const Side& before_;
  const Side& after_;
  std::vector<Pair> pairs_;
  std::size_t done_ = 0;                                   ///< pairs whose children are paired
  std::unordered_map<json::NodeId, json::NodeId> theirs_;  ///< by ours
  std::unordered_map<json::NodeId, json::NodeId> ours_;    ///< by theirs
};

}  // namespace gltfx::prove
