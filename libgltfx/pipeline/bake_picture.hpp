// SPDX-License-Identifier: Apache-2.0
/// One picture of a scene.
#pragma once

#include <gltfx/bake.hpp>

#include <functional>

#include "bake/framebuffer.hpp"
#include "bake/view.hpp"
#include "pipeline/bake_scene.hpp"

namespace gltfx {

/// What the options ask for beside the picture itself.
bake::Layers layers_of(const BakeOptions& options);

/// Precondition: the scene is ready. `progress` may be empty.
bake::Framebuffer draw_picture(const BakeScene& loaded, const bake::View& view,
                               const BakeSize& size, const BakeOptions& options,
                               const bake::Layers& layers, std::function<void(double)> progress);

}  // namespace gltfx
