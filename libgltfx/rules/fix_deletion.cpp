// SPDX-License-Identifier: Apache-2.0
#include "rules/fix_deletion.hpp"

#include "graph/orphans.hpp"

namespace gltfx::validate {
namespace {

struct Orphaned {
  explicit Orphaned(Fixing& fixing) : orphans(fixing.graph()) {}
  graph::Orphans orphans;
};

// With a name that occurs twice it is unclear which value is meant.
bool is_sound(const Fixing& fixing) { return fixing.opened().parsed().errors.empty(); }

}  // namespace

bool delete_marked(Fixing& fixing, Span place) {
  graph::Place at{fixing.node_around(place), std::nullopt};
  if (at.node == json::kNoNode || !is_sound(fixing)) return false;
  if (fixing.document().kind(at.node) == json::Kind::number_array) {
    at.element = fixing.tree().number_at(at.node, place.begin);
  }
  fixing.delete_value(fixing.tree().pointer(at));
  return true;
}

bool delete_unused(Fixing& fixing, Span place) {
  const json::NodeId object = fixing.node_at(place);
  if (object == json::kNoNode || !is_sound(fixing)) return false;
  if (fixing.is_claimed(object)) return true;
  for (const json::NodeId each : fixing.table<Orphaned>().orphans.take(object)) {
    if (fixing.claim(each)) fixing.delete_value(fixing.tree().pointer(each));
  }
  return true;
}

}  // namespace gltfx::validate
