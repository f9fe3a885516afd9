// SPDX-License-Identifier: Apache-2.0
// The steps of codec_steps.hpp in WebAssembly, which has no codec workers.
#include "steps/codec_steps.hpp"

namespace gltfx::steps {

// --shrink converts all that it can; other options ask for images.
Result<StepOutcome> convert_images(const StepInput& input, const std::set<std::uint32_t>*) {
  if (!input.options.images.empty() || input.options.texture_size) {
    return Error{"this build does not encode images"};
  }
  return StepOutcome{};
}

Result<StepOutcome> encode_draco(const StepInput&) {
  return Error{"this build does not encode Draco meshes"};
}

}  // namespace gltfx::steps
