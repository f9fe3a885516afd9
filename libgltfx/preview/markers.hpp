// SPDX-License-Identifier: Apache-2.0
/// Points and lines as small solids: discs that face along the normal, octahedra where there is
/// none, and tubes. Their size follows from the scene's, so they are a few pixels wide in a picture
/// of all of it. Those without normals show base colour and emission (specification section 3.9.7).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "preview/framing.hpp"
#include "render/scene.hpp"

namespace gltfx::preview {

/// Markers of one mesh, at most.
inline constexpr std::size_t kMostMarkers = 100000;
/// Bytes that each marker of a mesh of such vertices takes.
std::size_t marker_bytes(const render::Mesh& vertices);

/// `vertices` has the attributes of the asset's vertices; its triangles count for nothing. The mesh
/// of one marker for each point, all of no size: give_markers_size() does that. At most
/// kMostMarkers of them, evenly chosen.
render::Mesh point_markers(const render::Mesh& vertices, std::span<const std::uint32_t> points);
/// Likewise for lines between two vertices.
render::Mesh line_markers(const render::Mesh& vertices,
                          std::span<const std::array<std::uint32_t, 2>> segments);

/// Makes all markers of a scene `radius` thick, in the scene's unit: exact for the first instance
/// of a mesh where that is scaled evenly.
void give_markers_size(render::Scene& scene, double radius);

/// A radius of a pixel or two in a picture of the subject with `side` pixels, in the scene's unit;
/// any where the subject is a single place.
double marker_radius(const Subject& subject, std::uint32_t side);

}  // namespace gltfx::preview
