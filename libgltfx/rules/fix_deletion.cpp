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

bool delete_marked(Fixing& fixing, const Subject& subject) {
  if (!is_sound(fixing)) return false;
  graph::Place at{subject.node(), std::nullopt};
  if (subject.value == json::kNoNode) {
    at.element = fixing.tree().number_at(subject.owner, subject.begin);
  }
  fixing.delete_value(fixing.tree().pointer(at));
  return true;
}

bool delete_unused(Fixing& fixing, const Subject& object) {
  if (object.value == json::kNoNode || !is_sound(fixing)) return false;
  if (fixing.is_claimed(object.value)) return true;
  for (const json::NodeId each : fixing.table<Orphaned>().orphans.take(object.value)) {
    if (fixing.claim(each)) fixing.delete_value(fixing.tree().pointer(each));
  }
  return true;
}

}  // namespace gltfx::validate
