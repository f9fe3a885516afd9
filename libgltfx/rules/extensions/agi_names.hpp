// SPDX-License-Identifier: Apache-2.0
/// Names that something refers to.
#pragma once

#include <vector>

#include "rules/context.hpp"

namespace gltfx::validate {

/// Reports NAME_REPEATED for each of `objects` with the `name` of one before it. `list` is the path
/// of their array; json::kNoNode stands for elements that are no objects.
void check_unique_names(const Context& context, const std::vector<json::NodeId>& objects,
                        const Path& list);

}  // namespace gltfx::validate
