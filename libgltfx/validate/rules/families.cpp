// SPDX-License-Identifier: Apache-2.0
#include "validate/rules/families.hpp"

#include <array>

namespace gltfx::validate {

std::span<const Family> families() {
  // The order is that in which link rules run: the specification's, bottom up.
  static const std::array all{
      glb_family(),           json_family(),     schema_family(),   extension_family(),
      extension_use_family(), fallback_family(), identity_family(), resource_family(),
  };
  return all;
}

}  // namespace gltfx::validate
