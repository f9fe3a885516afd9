// SPDX-License-Identifier: Apache-2.0
#include "steps/step.hpp"

namespace gltfx::steps {

StepDescription container_step();

std::vector<StepDescription> steps() { return {container_step()}; }

}  // namespace gltfx::steps
