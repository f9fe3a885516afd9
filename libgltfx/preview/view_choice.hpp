// SPDX-License-Identifier: Apache-2.0
/// The choice among views of many things, by what they show.
#pragma once

#include "preview/framing.hpp"
#include "render/bvh.hpp"
#include "render/scene.hpp"

namespace gltfx::preview {

/// The usual direction, unless another one shows clearly more: of upright rows, the front; of
/// things between walls without a ceiling, more from above. Traces some thousand rays if the scene
/// has several things. Precondition: the subject has its triangles.
Direction best_direction(const render::Scene& scene, const Subject& subject,
                         const render::Bvh& bvh);

}  // namespace gltfx::preview
