// SPDX-License-Identifier: Apache-2.0
/// Steps that encode in codec workers. Builds without workers refuse them.
#pragma once

#include "base/result.hpp"
#include "steps/images.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// Stores triangles and their vertices as Draco bitstreams.
Result<StepOutcome> encode_draco(const StepInput& input);

}  // namespace gltfx::steps
