// SPDX-License-Identifier: Apache-2.0
/// Vertices that no index reads.
#pragma once

#include <cstdint>

#include "base/result.hpp"
#include "change/change.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

struct PrunedVertices {
  change::Change change;
  std::uint64_t vertices = 0;  ///< that are gone; 0: there is no change
};

/// Takes them out of primitives, and notes in `row` where that is not possible.
Result<PrunedVertices> prune_vertices(const StepInput& input, ConvertStep& row);

}  // namespace gltfx::steps
