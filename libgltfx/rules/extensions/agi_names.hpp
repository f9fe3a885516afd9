// SPDX-License-Identifier: Apache-2.0
/// Names that other objects refer to.
#pragma once

#include <vector>

#include "rules/context.hpp"

namespace gltfx::validate {

/// Reports NAME_REPEATED for each of `objects` with the `name` of an earlier one. `list` is the
/// path of their array; elements that are not objects are json::kNoNode.
void check_unique_names(const Context& context, const std::vector<json::NodeId>& objects,
                        const Path& list);

}  // namespace gltfx::validate
