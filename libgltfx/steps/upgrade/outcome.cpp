// SPDX-License-Identifier: Apache-2.0
#include <gltfx/upgrade.hpp>

#include <algorithm>

namespace gltfx {

std::string_view upgrade_outcome_name(UpgradeOutcome outcome) {
  switch (outcome) {
    case UpgradeOutcome::safe:
      return "safe";
    case UpgradeOutcome::unsafe:
      return "unsafe";
    case UpgradeOutcome::needs_image:
      return "needs an image";
    case UpgradeOutcome::on_request:
      return "on request";
    case UpgradeOutcome::no_successor:
      return "no successor";
    case UpgradeOutcome::impossible:
      break;
  }
  return "not possible";
}

std::uint64_t UpgradeReport::due() const {
  return static_cast<std::uint64_t>(std::count_if(
      actions.begin(), actions.end(), [](const UpgradeAction& action) { return action.is_due(); }));
}

std::uint64_t UpgradeReport::left() const {
  return static_cast<std::uint64_t>(
      std::count_if(actions.begin(), actions.end(),
                    [](const UpgradeAction& action) { return action.is_due() && !action.done; }));
}

}  // namespace gltfx
