// SPDX-License-Identifier: Apache-2.0
#include "steps/upgrade/choice.hpp"

#include <algorithm>

namespace gltfx::upgrade {
namespace {

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

Choice choose(const UpgradeOptions& options, const schema::Extension& extension) {
  const schema::Upgrade& upgrade = extension.upgrade;
  Choice choice{Selection::yes, upgrade.to};
  if (!options.only.empty() && !has(options.only, extension.name)) choice.selection = Selection::no;
  if (!options.to.empty() && !has(options.to, upgrade.to)) {
    const auto other = std::find_if(upgrade.alternatives.begin(), upgrade.alternatives.end(),
                                    [&](const std::string& name) { return has(options.to, name); });
    if (other == upgrade.alternatives.end()) return {Selection::no, upgrade.to};
    choice.to = *other;
  }
  const bool asked = !options.only.empty() || !options.to.empty();
  if (!asked && !upgrade.opt_in.empty()) choice.selection = Selection::offered;
  return choice;
}

std::vector<std::string> legacy_names(const schema::Set& set) {
  std::vector<std::string> names;
  for (const schema::Extension& extension : set.extensions()) {
    if (extension.upgrade.does_something()) names.push_back(extension.name);
  }
  return names;
}

std::vector<std::string> successor_names(const schema::Set& set) {
  std::vector<std::string> names;
  for (const schema::Extension& extension : set.extensions()) {
    if (extension.upgrade.to.empty()) continue;
    const auto& others = extension.upgrade.alternatives;
    names.insert(names.end(), others.begin(), others.end());
    names.push_back(extension.upgrade.to);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace gltfx::upgrade
