// SPDX-License-Identifier: Apache-2.0
/// Runs a step that loses something within bounds.
#pragma once

#include "base/result.hpp"
#include "steps/step.hpp"

namespace gltfx {

/// Runs a step and measures what it loses. What exceeds its bound is tried again with less, and
/// then left exact. The row of the outcome has the measured losses. Returns an Error (half a
/// sentence) if the step fails, or if it changes anything else.
Result<steps::StepOutcome> run_within_bounds(const steps::StepDescription& step,
                                             const steps::StepInput& input);

}  // namespace gltfx
