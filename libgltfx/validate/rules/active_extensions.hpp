// SPDX-License-Identifier: Apache-2.0
/// Which extensions of an asset rules look into.
#pragma once

#include <string_view>
#include <vector>

#include "validate/context.hpp"

namespace gltfx::validate {

/// Those that the Set knows, unless Deviations::unsupported_extensions_are_skipped: then those that
/// the Khronos validator supports and the asset declares. Made once for a link rule; the context
/// must outlive it.
class ActiveExtensions {
 public:
  explicit ActiveExtensions(const Context& context);

  bool contains(std::string_view name) const;
  /// The active extension of that name, or null.
  const schema::Extension* find(std::string_view name) const;

 private:
  const schema::Set& schemas_;
  std::vector<bool> active_;  // by ExtensionId
};

/// The extensions of the asset's `extensionsUsed` that are active, in its order.
std::vector<const schema::Extension*> declared_extensions(const Context& context);

}  // namespace gltfx::validate
