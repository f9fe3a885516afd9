// SPDX-License-Identifier: Apache-2.0
/// The ways in which an asset is stored.
#pragma once

#include "base/result.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// One GLB with all buffers and images.
Result<StepOutcome> pack(const StepInput& input);

/// JSON text, with files or with data URIs as the options say.
Result<StepOutcome> store_as_text(const StepInput& input);

/// Adds what was not dealt with to a list of a row.
void note(std::vector<ConvertNote>& notes, std::string pointer, std::string reason);

}  // namespace gltfx::steps
