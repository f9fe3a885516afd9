// SPDX-License-Identifier: Apache-2.0
/// One material becomes several that differ in one member of an extension.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "json/edit.hpp"

namespace gltfx::upgrade {

struct Context;

/// A copy of an element of the root's materials as the plan leaves it.
struct MaterialSplit {
  json::NodeId material = json::kNoNode;
  std::vector<std::string> member;  ///< path of what is different in the copy
  std::string json;                 ///< its value there
  std::vector<json::NodeId> users;  ///< numbers that lead to the copy from now on
};

/// Plans a copy. Gives its index in the root's materials.
std::uint64_t split_material(Context& context, MaterialSplit split);
/// Adds the copies, when all edits of the plan are known.
void settle_splits(Context& context);

}  // namespace gltfx::upgrade
