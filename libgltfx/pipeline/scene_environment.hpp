// SPDX-License-Identifier: Apache-2.0
/// The light from all around that an asset brings (EXT_lights_image_based).
#pragma once

#include "model/light.hpp"
#include "model/memory_budget.hpp"
#include "model/resource_data.hpp"
#include "pipeline/scene_materials.hpp"
#include "render/scene.hpp"

namespace gltfx {

/// The sharpest cube map, unrolled: surfaces gather from it what the blurred maps and the
/// irradiance say to renderers that do not. Where an image of it cannot be had, the light that the
/// irradiance comes from. Notes tell that, and where the two disagree.
render::EnvironmentImage environment_of(const model::EnvironmentLight& light,
                                        const model::ResourceData& resources,
                                        model::MemoryBudget& budget, SceneNotes& notes);

}  // namespace gltfx
