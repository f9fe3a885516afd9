// SPDX-License-Identifier: Apache-2.0
/// What the makers of a model look at beside its materials.
#pragma once

#include <cstdint>

#include "render/framebuffer.hpp"
#include "render/integrator.hpp"
#include "render/render.hpp"
#include "render/view.hpp"

namespace gltfx::preview {

/// Gives all surfaces one opaque, grey, matt material. Sides that are culled stay so.
void make_clay(render::Scene& scene);

/// Draws the edges of the triangles that are seen, 1.2 pixels wide.
void draw_wireframe(const render::TraceContext& context, const render::View& view, unsigned jobs,
                    render::Framebuffer& picture);

enum class Diagram : std::uint8_t {
  uv,       ///< squares of texture coordinates
  density,  ///< texels for each metre
  facing,   ///< fronts and backs of triangles
};

/// A color for each surface, lit from the camera, in front of the background; linear, from 0 to 1.
/// Has the layers that are asked for.
render::Framebuffer draw_diagram(const render::TraceContext& context, const render::View& view,
                                 Diagram diagram, const render::PictureOptions& options);

}  // namespace gltfx::preview
