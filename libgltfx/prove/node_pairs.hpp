// SPDX-License-Identifier: Apache-2.0
/// Corresponding nodes of two assets: by their places in the scenes, not by number.
#pragma once

#include <unordered_map>
#include <utility>
#include <vector>

#include "prove/side.hpp"

namespace gltfx::prove {

/// A one-to-one relation. Nodes are identified by place: two equal nodes are not the same.
class NodePairs {
 public:
  /// Roots of scenes in order, then roots outside of scenes, then the other nodes, each with its
  /// children in order. Iterative; linear.
  NodePairs(const Side& before, const Side& after);

  const std::vector<std::pair<json::NodeId, json::NodeId>>& all() const { return pairs_; }
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
  std::vector<std::pair<json::NodeId, json::NodeId>> pairs_;
  std::size_t done_ = 0;                                   ///< number of pairs with paired children
  std::unordered_map<json::NodeId, json::NodeId> theirs_;  ///< by node of `before`
  std::unordered_map<json::NodeId, json::NodeId> ours_;    ///< by node of `after`
};

}  // namespace gltfx::prove
