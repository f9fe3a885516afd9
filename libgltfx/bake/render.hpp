// SPDX-License-Identifier: Apache-2.0
/// A finished picture of a scene, in memory that does not grow with what its samples tell.
#pragma once

#include "bake/framebuffer.hpp"
#include "bake/render_rows.hpp"

namespace gltfx::bake {

struct PictureOptions {
  RenderOptions render;  ///< its progress is that of the whole picture
  Layers layers;
  bool denoise = false;
};

/// Renders and finishes some rows after the others: samples are summed up for those that are at
/// work only, unless there is a limit of time, which all rows share. The same bytes for any number
/// of jobs, without such a limit.
Framebuffer render(const TraceContext& context, const View& view, const PictureOptions& options);

}  // namespace gltfx::bake
