// SPDX-License-Identifier: Apache-2.0
// What stands beside a legacy object, and whether the object does anything there.
#include <fmt/format.h>

#include "upgrade/object_plan.hpp"

namespace gltfx::upgrade {

ObjectPlan::Problem ObjectPlan::blocker() const {
  for (const schema::Relation& other : extension_.upgrade.blocked_by) {
    if (has_beside(other.extension)) {
      return fmt::format("{} stands beside it: {}", other.extension, other.because);
    }
  }
  return std::nullopt;
}

// Objects without effect.
ObjectPlan::Problem ObjectPlan::reason_to_go() {
  const schema::Upgrade& upgrade = extension_.upgrade;
  if (has_beside(successor_.name)) {
    return fmt::format("{} stands beside it already and is what readers use", successor_.name);
  }
  for (const schema::Relation& hider : upgrade.hidden_by) {
    if (!has_beside(hider.extension)) continue;
    std::string_view because = hider.because;  // a sentence, of which a part of one is made
    if (because.ends_with('.')) because.remove_suffix(1);
    return fmt::format("without effect: {}", because);
  }
  if (conversion_ != nullptr) {
    if (Problem why = conversion_->reason_to_go(bench())) return why;
  }
  if (upgrade.strength.empty() ||
      is_pointed_at({"extensions", extension_.name, upgrade.strength})) {
    return std::nullopt;
  }
  const json::NodeId strength = document_.find(carrier_.object, upgrade.strength);
  if (strength == json::kNoNode) return fmt::format("without effect: no {}", upgrade.strength);
  const bool off = document_.is_number(strength) && document_.number(strength).value == 0;
  if (!off) return std::nullopt;
  return fmt::format("without effect: {} is 0", upgrade.strength);
}

// What the successor excludes is in the way. What only the old one excludes was not to be seen.
ObjectPlan::Problem ObjectPlan::judge_company() {
  for (const schema::Relation& excluded : successor_.excludes) {
    if (excluded.extension == extension_.name || !has_beside(excluded.extension)) continue;
    return fmt::format("{} must not stand beside {}: {}", successor_.name, excluded.extension,
                       excluded.because);
  }
  for (const schema::Relation& excluded : extension_.excludes) {
    if (!has_beside(excluded.extension)) continue;
    lose(fmt::format("{}, which must not stand beside {}, takes effect: {}", excluded.extension,
                     extension_.name, excluded.because));
  }
  return std::nullopt;
}

}  // namespace gltfx::upgrade
