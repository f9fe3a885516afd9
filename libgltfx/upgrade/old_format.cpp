// SPDX-License-Identifier: Apache-2.0
#include "upgrade/old_format.hpp"

#include <utility>

#include "model/fields.hpp"
#include "model/format_version.hpp"

namespace gltfx::upgrade {

UpgradeAction old_format(const UpgradeOptions& options, std::string pointer,
                         const std::string& version) {
  const bool limited = !options.only.empty() || !options.to.empty();
  UpgradeAction action;
  action.pointer = std::move(pointer);
  action.from = "glTF " + version;
  action.fate = limited ? UpgradeFate::no_successor : UpgradeFate::impossible;
  action.notes.emplace_back("glTF 1.0 is not supported; convert it with gltf-pipeline:");
  action.notes.emplace_back("npx gltf-pipeline -i OLD -o NEW");
  return action;
}

std::optional<UpgradeAction> find_old_format(const json::Document& document,
                                             const UpgradeOptions& options) {
  if (!model::is_gltf_1(document)) return std::nullopt;
  const json::NodeId asset = document.find(document.root(), "asset");
  const json::NodeId version = document.find(asset, "version");
  if (version == json::kNoNode) return old_format(options);
  const std::string text = model::string_member(document, asset, "version");
  return old_format(options, "/asset/version", text.empty() ? "1.0" : text);
}

}  // namespace gltfx::upgrade
