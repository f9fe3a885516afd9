// SPDX-License-Identifier: Apache-2.0
/// Which node of one asset is which of the other: by their places in the scenes, not by number.
#pragma once

#include <unordered_map>
#include <utility>
#include <vector>

#include "prove/side.hpp"

namespace gltfx::prove {

/// One to one. Nodes are told apart by where they are: two that are equal are not the same.
class NodePairs {
 public:
  /// Roots of scenes in order, then roots outside of scenes, then what is left, each with its
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
  std::size_t done_ = 0;                                   ///< pairs whose children are paired
  std::unordered_map<json::NodeId, json::NodeId> theirs_;  ///< by ours
  std::unordered_map<json::NodeId, json::NodeId> ours_;    ///< by theirs
};

}  // namespace gltfx::prove
