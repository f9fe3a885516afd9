// SPDX-License-Identifier: Apache-2.0
/// Rendering of a scene to a framebuffer, in memory that does not grow with the samples.
#pragma once

#include "bake/framebuffer.hpp"
#include "bake/render_rows.hpp"

namespace gltfx::bake {

struct PictureOptions {
  RenderOptions render;  ///< progress is that of the whole picture
  Layers layers;
  bool denoise = false;
};

/// Renders, resolves and denoises some rows after the others, so that the film holds few rows;
/// with a time limit, which all rows share, it holds all. Without one the values are the same for
/// any number of jobs.
Framebuffer render(const TraceContext& context, const View& view, const PictureOptions& options);

}  // namespace gltfx::bake
