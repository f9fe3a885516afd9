// SPDX-License-Identifier: Apache-2.0
/// One picture of a scene.
#pragma once

#include <gltfx/bake.hpp>

#include <functional>

#include "bake/canvas.hpp"
#include "bake/view.hpp"
#include "pipeline/bake_scene.hpp"

namespace gltfx {

/// With the layers that the options ask for. Precondition: the scene is ready. `progress` may be
/// empty.
bake::Canvas draw_picture(const BakeScene& loaded, const bake::View& view, const BakeSize& size,
                          const BakeOptions& options, std::function<void(double)> progress);

}  // namespace gltfx
