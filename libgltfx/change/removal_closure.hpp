// SPDX-License-Identifier: Apache-2.0
/// Finds all values to remove for some removed values: those that need them, and on request those
/// that refer to them.
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

/// A value that prevents a removal, because it needs the removed value or refers to it.
struct Obstacle {
  Place at;      ///< the reference, or the object that must have the member
  Place target;  ///< the value to remove
  bool owner = false;
};

/// A value that is removed, with all that it contains.
struct Removed {
  Place place;
  Place cause;  ///< removed value that caused it; a null node: requested
};

class Removals {
 public:
  /// `cascade`: values that prevent a removal are removed, too.
  Removals(const Graph& graph, bool cascade)
      : graph_(graph), cascade_(cascade), gone_(graph.tree().document().node_count(), false) {}

  /// Removes values. Returns why one must stay, or nothing.
  std::optional<std::string> remove(std::span<const Place> places);

  bool is_gone(Place place) const;
  bool is_gone(json::NodeId value) const { return gone_[value]; }
  /// Removed values that are not inside other removed values.
  std::vector<Removed> outermost() const;
  /// Without cascade: values that prevent the removal.
  std::vector<Obstacle> obstacles() const;

 private:
  struct Step {
    Place place;
    Place cause;
    bool asked = false;
  };

  std::optional<std::string> resolve(Step step);
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
