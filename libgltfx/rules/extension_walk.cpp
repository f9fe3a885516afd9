// SPDX-License-Identifier: Apache-2.0
#include "rules/extension_walk.hpp"

namespace gltfx::validate {

ActiveExtensions::ActiveExtensions(const Context& context)
    : schemas_(context.schemas), all_(!context.deviations.unsupported_extensions_are_skipped) {
  if (all_) return;
  for (const std::string& name : context.checked.extensions_used) {
    const schema::ExtensionId id = schemas_.find_extension(name);
    if (id != schema::kNone && schemas_.extensions()[id].khronos_validator) active_.push_back(id);
  }
}

const schema::Extension* ActiveExtensions::find(std::string_view name) const {
  if (!all_ && active_.empty()) return nullptr;
  const schema::ExtensionId id = schemas_.find_extension(name);
  if (id == schema::kNone) return nullptr;
  const bool active = all_ || std::find(active_.begin(), active_.end(), id) != active_.end();
  return active ? &schemas_.extensions()[id] : nullptr;
}

bool ActiveExtensions::contains(std::string_view name) const { return find(name) != nullptr; }

std::vector<const schema::Extension*> declared_extensions(const Context& context) {
  const ActiveExtensions active(context);
  std::vector<const schema::Extension*> declared;
  for (const std::string& name : context.checked.extensions_used) {
    const schema::Extension* extension = active.find(name);
    if (extension != nullptr) declared.push_back(extension);
  }
  return declared;
}

std::vector<const schema::Extension*> instancing_extensions(const Context& context) {
  std::vector<schema::ExtensionId> ids;
  for (const std::string_view name : context.checked.extensions_seen) {
    const schema::ExtensionId id = context.schemas.find_extension(name);
    if (id == schema::kNone) continue;
    if (!context.schemas.extensions()[id].instance_attributes.empty()) ids.push_back(id);
  }
  std::sort(ids.begin(), ids.end());
  std::vector<const schema::Extension*> found;
  for (const schema::ExtensionId id : ids) found.push_back(&context.schemas.extensions()[id]);
  return found;
}

}  // namespace gltfx::validate
