// SPDX-License-Identifier: Apache-2.0
/// One picture of a scene, or what becomes of a file that cannot be drawn at all.
#pragma once

#include <gltfx/bake.hpp>

#include <functional>
#include <string>

#include "pipeline/bake_scene.hpp"
#include "preview/picture.hpp"
#include "render/framebuffer.hpp"
#include "render/view.hpp"

namespace gltfx {

/// The report on a file that could not be read.
BakeReport unreadable(const std::string& path, std::string why);

/// What `work` says of the file; the library does not throw.
BakeReport guarded(const std::string& path, const std::function<BakeReport()>& work);

/// Whether a flat scene is as bright at its edges as the backdrop: less than 16 steps of lightness
/// (CIE L*) from it. Precondition: the scene is ready, and its backdrop not dimmed.
bool needs_dim_backdrop(const BakeScene& loaded, const render::View& view,
                        const BakeOptions& options);

/// Whether pictures have an alpha channel.
bool is_transparent(const BakeOptions& options);

/// What the options ask for beside the picture itself.
render::Layers layers_of(const BakeOptions& options);

/// Precondition: the scene is ready. `progress` may be empty.
render::Framebuffer draw_picture(const BakeScene& loaded, const render::View& view,
                                 const BakeSize& size, const BakeOptions& options,
                                 const render::Layers& layers,
                                 std::function<void(double)> progress);

/// The pixels of what was drawn with the same options.
preview::Picture finish_picture(const render::Framebuffer& drawn, const BakeOptions& options,
                                preview::PixelType type);

}  // namespace gltfx
