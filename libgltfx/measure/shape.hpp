// SPDX-License-Identifier: Apache-2.0
/// The geometry of a mesh in its own space: as it is stored, without morph targets and skins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "base/packed.hpp"
#include "measure/source.hpp"
#include "model/geometry.hpp"
#include "model/memory_budget.hpp"

namespace gltfx::measure {

/// Bytes that measures may take for the geometry of an asset: more than its buffers can be worth.
std::uint64_t geometry_bytes(const Source& source);

/// Reasons why geometry cannot be read, one sentence.
inline constexpr std::string_view kTooLarge =
    "The geometry asks for more memory than its bytes are worth.";
inline constexpr std::string_view kNoIndices = "A primitive has no indices that can be read.";
/// Of a primitive without positions that can be read.
std::string_view missing_positions(const model::PrimitiveData& data);

/// The bitstream and the POSITION accessor of a primitive, or 0: primitives with equal ones have
/// the same vertices.
using VertexKey = std::pair<std::uint64_t, std::uint64_t>;
VertexKey vertex_key(const Source& source, const model::Primitive& primitive);

inline constexpr std::string_view kUnreadVertices = "Vertices could not be read.";

/// Whether it has a mode that draws triangles, and positions.
bool draws_triangles(const model::Primitive& primitive);
/// Pointers to the elements.
std::vector<const model::Primitive*> pointers_to(const std::vector<model::Primitive>& primitives);
/// Whether there is something to draw that could not be read.
bool is_fault(model::GeometryError error);

/// A primitive of a list, read.
struct ReadPrimitive {
  std::size_t at = 0;  ///< its index in the list
  bool fresh = false;  ///< the first with these vertices; those that have them, too, follow
  model::GeometryError error = model::GeometryError::none;
  model::Geometry& geometry;  ///< vertices may be taken out, but for positions
};
/// Reads those primitives of a list that have positions. Vertices that several of them share are
/// read once. Stops when `use` returns false. Precondition: no surface is requested.
void read_primitives(const Source& source, std::span<const model::Primitive* const> primitives,
                     const model::GeometryRequest& request, model::MemoryBudget& budget,
                     const std::function<bool(const ReadPrimitive&)>& use);

/// The triangles of all primitives of a mesh.
struct Shape {
  std::vector<Float3> positions;           ///< those of an accessor once
  std::vector<model::Triangle> triangles;  ///< every vertex exists
  std::uint64_t collapsed = 0;  ///< triangles that are left out because they have a vertex twice
};

/// Empty, or why the shape cannot be read, one sentence. Takes from the budget what the shape and
/// its Surface need.
std::string_view read_shape(const Source& source, const model::Mesh& mesh,
                            model::MemoryBudget& budget, Shape& shape);

/// What a mesh is made from: meshes with equal ones have equal shapes.
std::vector<std::uint64_t> shape_key(const Source& source, const model::Mesh& mesh);

}  // namespace gltfx::measure
