// SPDX-License-Identifier: Apache-2.0
/// Which values go when some are to go: with them what cannot stand without them, and on request
/// what refers to them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "graph/graph.hpp"

namespace gltfx::change {

using graph::Graph;
using graph::Place;
using graph::Tree;

/// What stands against a removal, because it needs the value or refers to it.
struct Obstacle {
  Place at;      ///< the reference, or the object that must have the member
  Place target;  ///< what was to go
  bool owner = false;
};

/// A value that goes, with all that is in it.
struct Removed {
  Place place;
  Place cause;  ///< what went before it; a null node: it was asked for
};

class Removals {
 public:
  /// `cascade`: what stands against a removal goes, too.
  Removals(const Graph& graph, bool cascade)
      : graph_(graph), cascade_(cascade), gone_(graph.tree().document().node_count(), false) {}

  /// Takes values out; why one must stay, or nothing.
  std::optional<std::string> remove(std::span<const Place> places);

  bool is_gone(Place place) const;
  bool is_gone(json::NodeId value) const { return gone_[value]; }
  /// What went as a whole, and lies in nothing else that went.
  std::vector<Removed> outermost() const;
  /// Without cascade: what stands against it. Empty when nothing does.
  std::vector<Obstacle> obstacles() const;

 private:
  struct Step {
    Place place;
    Place cause;
    bool asked = false;
  };

  std::optional<std::string> settle(Step step);
  std::optional<std::string> find_position_obstacle(Place place) const;
  json::NodeId container(Place place) const;
  bool empties(Place place) const;
  bool falls(json::NodeId object, const Step& step) const;
  bool lives(json::NodeId object, std::string_view member, json::NodeId without) const;
  bool has_alternative(const schema::Shape& shape, json::NodeId object, json::NodeId without) const;
  void take_out(const Step& step);
  void need(Place at, Place target, bool owner);
  void drop_dependents(json::NodeId object, Place place);

  const Graph& graph_;
  const bool cascade_;
  std::vector<bool> gone_;  ///< by node
  std::map<json::NodeId, std::set<std::uint64_t>> gone_numbers_;
  std::unordered_map<json::NodeId, std::uint64_t> lost_;  ///< items, by container
  std::vector<Removed> removed_;
  std::vector<Obstacle> obstacles_;
  std::vector<Step> waiting_;
};

}  // namespace gltfx::change
