// SPDX-License-Identifier: Apache-2.0
/// The step that stores images in another format or size.
#pragma once

#include <cstdint>
#include <set>

#include "base/result.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// Does what the options request of images. With `only`, images, by index: of these and of those
/// with the same file or buffer view.
Result<StepOutcome> convert_images(const StepInput& input,
                                   const std::set<std::uint32_t>* only = nullptr);

}  // namespace gltfx::steps
