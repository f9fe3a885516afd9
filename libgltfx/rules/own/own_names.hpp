// SPDX-License-Identifier: Apache-2.0
/// Names in the schema of an own rule that the objects of its scope never have.
#pragma once

#include <string>
#include <vector>

#include "rules/own/own_page.hpp"

namespace gltfx::validate {

/// A member that no object of the scope has, so that a requirement on it never fails or always
/// does.
struct UnknownMember {
  std::string name;
  std::string mistake;  ///< a clause with the nearest name
};

/// Looks at members of the object itself and of `gltfx` in it. Other members may come from
/// extensions.
std::vector<UnknownMember> unknown_members(const schema::JsonSchema& schema, const OwnScope& scope);

}  // namespace gltfx::validate
