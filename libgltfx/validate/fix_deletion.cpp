// SPDX-License-Identifier: Apache-2.0
#include "validate/fix_deletion.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

#include "edit/graph.hpp"

namespace gltfx::validate {
namespace {

/// What refers to what in the asset, and how many of these references are left.
class Referrers {
 public:
  explicit Referrers(Fixing& fixing)
      : tree_(fixing.document()),
        graph_(tree_, fixing.schemas()),
        // A name that occurs twice leaves open which value is meant.
        is_sound_(fixing.opened().parsed().errors.empty()) {
    for (const edit::IndexUse& use : graph_.indices()) {
      if (use.list == json::kNoNode || !fixing.document().is_array(use.list)) continue;
      note(use.at.node, tree_.element(use.list, use.index));
    }
    for (const edit::PointerText& pointer : graph_.pointers()) {
      for (const json::NodeId step : pointer.way) note(pointer.at, step);
    }
    std::sort(uses_.begin(), uses_.end());
  }

  bool is_sound() const { return is_sound_; }
  const edit::Tree& tree() const { return tree_; }

  /// The object, and what is of no use without it.
  std::vector<json::NodeId> with_dependents(json::NodeId object) {
    std::vector<json::NodeId> all{object};
    for (std::size_t i = 0; i < all.size(); ++i) {
      const json::NodeId end = tree_.document().next(all[i]);
      auto use = std::lower_bound(uses_.begin(), uses_.end(), std::pair(all[i], json::NodeId{0}));
      for (; use != uses_.end() && use->first < end; ++use) {
        const json::NodeId list = tree_.parent(use->second);
        const bool of_root = tree_.parent(list) == tree_.document().root();
        if (--left_[use->second] == 0 && of_root) all.push_back(use->second);
      }
    }
    return all;
  }

 private:
  void note(json::NodeId at, json::NodeId target) {
    if (target == json::kNoNode) return;
    uses_.emplace_back(at, target);
    ++left_[target];
  }

  const edit::Tree tree_;
  const edit::Graph graph_;
  const bool is_sound_;
  std::vector<std::pair<json::NodeId, json::NodeId>> uses_;  ///< place and target, sorted
  std::unordered_map<json::NodeId, std::uint64_t> left_;     ///< by target
};

}  // namespace

bool delete_marked(Fixing& fixing, Span place) {
  const Referrers& users = fixing.table<Referrers>();
  edit::Place at{fixing.node_around(place), std::nullopt};
  if (at.node == json::kNoNode || !users.is_sound()) return false;
  if (fixing.document().kind(at.node) == json::Kind::number_array) {
    at.element = users.tree().number_at(at.node, place.begin);
  }
  fixing.delete_value(users.tree().pointer(at));
  return true;
}

bool delete_unused(Fixing& fixing, Span place) {
  auto& users = fixing.table<Referrers>();
  const json::NodeId object = fixing.node_at(place);
  if (object == json::kNoNode || !users.is_sound()) return false;
  if (fixing.is_claimed(object)) return true;
  for (const json::NodeId each : users.with_dependents(object)) {
    if (fixing.claim(each)) fixing.delete_value(users.tree().pointer(each));
  }
  return true;
}

}  // namespace gltfx::validate
