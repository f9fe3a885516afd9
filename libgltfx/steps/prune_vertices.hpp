// SPDX-License-Identifier: Apache-2.0
/// Removes vertices that no index uses.
#pragma once

#include <cstdint>

#include "base/result.hpp"
#include "change/change.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

struct PrunedVertices {
  change::Change change;
  std::uint64_t vertices = 0;  ///< removed; 0: there is no change
};

/// Removes unused vertices from primitives. Adds notes to `row` about primitives where that is not
/// possible. Returns an Error (half a sentence) if bytes cannot be read.
Result<PrunedVertices> prune_vertices(const StepInput& input, ConvertStep& row);

}  // namespace gltfx::steps
