// SPDX-License-Identifier: Apache-2.0
/// How far decoded elements may be from what an accessor declares: codecs round.
#pragma once

#include <optional>

#include "validate/data/check.hpp"
#include "validate/data/phases.hpp"

namespace gltfx::validate {

/// What the view of an accessor was decoded to, or null.
const model::DecodedView* decoded_view(const DataPhase& phase, const Schedule& schedule);

/// Gives checks of accessors whose view went through a filter that rounds the slack that this
/// takes.
void allow_rounding(const DataPhase& phase, Schedule& schedule);

/// The same for values that were quantised in steps of `step`: they are no more than a step away
/// from those that were meant, but for what single precision loses. Encoders widen bounds by a
/// whole step, and some by one of eight bits where they leave the values as they are (`step` 0).
void allow_quantization(Schedule& schedule, const std::optional<double>& step);

}  // namespace gltfx::validate
