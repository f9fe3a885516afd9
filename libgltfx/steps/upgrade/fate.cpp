// SPDX-License-Identifier: Apache-2.0
#include <gltfx/upgrade.hpp>

#include <algorithm>

namespace gltfx {

std::string_view upgrade_fate_name(UpgradeFate fate) {
  switch (fate) {
    case UpgradeFate::safe:
      return "safe";
    case UpgradeFate::unsafe:
      return "unsafe";
    case UpgradeFate::needs_image:
      return "needs an image";
    case UpgradeFate::on_request:
      return "on request";
    case UpgradeFate::no_successor:
      return "no successor";
    case UpgradeFate::impossible:
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
