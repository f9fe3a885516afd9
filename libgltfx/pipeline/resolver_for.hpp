// SPDX-License-Identifier: Apache-2.0
/// Where an asset's references may lead.
#pragma once

#include <filesystem>
#include <string>

#include "container/resolver.hpp"

namespace gltfx {

/// The asset's folder is the base of its references; the root of trust is that folder or a wider
/// one that the user named.
inline container::Resolver resolver_for(const std::filesystem::path& folder,
                                        const std::string& root) {
  const std::filesystem::path base = folder.empty() ? std::filesystem::path(".") : folder;
  return {root.empty() ? base : std::filesystem::path(root), base};
}

}  // namespace gltfx
