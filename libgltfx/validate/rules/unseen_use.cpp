// SPDX-License-Identifier: Apache-2.0
#include "validate/rules/unseen_use.hpp"

namespace gltfx::validate {

std::string_view unseen_user(const Context& context) {
  if (context.deviations.unsupported_extensions_are_skipped) return {};
  for (const std::string& name : context.checked.extensions_seen) {
    if (context.schemas.find_extension(name) == schema::kNone) return name;
  }
  return {};
}

}  // namespace gltfx::validate
