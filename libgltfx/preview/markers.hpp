// SPDX-License-Identifier: Apache-2.0
/// Points and lines as small solids: discs that face along the normal, octahedra for points without
/// one, and tubes. Their size depends on that of the scene: a few pixels in a picture of all of it.
/// Those without normals show base colour and emission (specification section 3.9.7).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "preview/framing.hpp"
#include "render/scene.hpp"

namespace gltfx::preview {

/// Maximum number of markers of one mesh.
inline constexpr std::size_t kMostMarkers = 100000;
/// Bytes of each marker of a mesh with such vertices.
std::size_t marker_bytes(const render::Mesh& vertices);

/// `vertices` has the attributes of the asset's vertices; its triangles are ignored. Returns a mesh
/// of one marker for each point, all of size 0 until give_markers_size(). At most kMostMarkers of
/// them, evenly chosen.
render::Mesh point_markers(const render::Mesh& vertices, std::span<const std::uint32_t> points);
/// Likewise for lines between two vertices.
render::Mesh line_markers(const render::Mesh& vertices,
                          std::span<const std::array<std::uint32_t, 2>> segments);

/// Whether a scene has markers without a size.
bool has_markers(const render::Scene& scene);

/// Makes all markers of a scene `radius` thick, in the scene's unit: exact for the first instance
/// of a mesh if that is scaled uniformly.
void give_markers_size(render::Scene& scene, double radius);

/// A radius of a pixel or two in a picture of the subject with `side` pixels, in the scene's unit;
/// any value if the subject is a single point.
double marker_radius(const Subject& subject, std::uint32_t side);

}  // namespace gltfx::preview
