// SPDX-License-Identifier: Apache-2.0
/// A primitive as plain triangles: decompressed, converted to single precision, morphed and skinned
/// to one pose (specification section 3.7).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "model/affine.hpp"
#include "model/draco.hpp"
#include "model/elements.hpp"
#include "model/memory_budget.hpp"
#include "model/mesh.hpp"
#include "model/triangles.hpp"

namespace gltfx::model {

/// Where the elements of accessors come from. All of it must outlive the source.
struct GeometrySource {
  const Asset& asset;
  const Views& views;
  const ResourceData& resources;
  const DracoMeshes& draco;
};

/// The vertex data of a primitive, in its own bitstream or in accessors. Keeps no more than
/// references; the source and the primitive must outlive it.
class PrimitiveData {
 public:
  PrimitiveData(const GeometrySource& source, const Primitive& primitive);

  const GeometrySource& source() const { return source_; }
  const Primitive& primitive() const { return primitive_; }
  /// The decoded bitstream, or null.
  const codec::DracoMesh* packed() const { return packed_; }

  /// The elements of an attribute; nothing when it is not there, cannot be read, or is neither
  /// stored nor sparse, that is zero throughout.
  std::optional<AccessorData> open(SemanticKind kind, std::uint64_t set = 0) const;
  /// The elements of an accessor that is no attribute of a bitstream.
  std::optional<AccessorData> open(const std::optional<std::uint32_t>& accessor) const;

 private:
  const GeometrySource& source_;
  const Primitive& primitive_;
  std::optional<DracoReference> reference_;
  const codec::DracoMesh* packed_ = nullptr;
};

/// What to read, and the pose.
struct GeometryRequest {
  std::span<const std::uint32_t> tex_coords;  ///< the n of each TEXCOORD_n to read
  std::span<const float> weights;             ///< of the morph targets; missing ones are 0
  /// Of the skin: from the space of the mesh to that of the scene. Empty: not skinned.
  std::span<const Affine> joints;
};

/// Lists of vertices have the same length, or none where there is no such attribute.
struct Geometry {
  Vectors<3> positions;
  Vectors<3> normals;                  ///< of length 1, or 0 where none could be told
  Vectors<4> tangents;                 ///< likewise; w is 1 or -1
  std::vector<Vectors<2>> tex_coords;  ///< as requested
  Vectors<4> colors;                   ///< COLOR_0: linear, from 0 to 1
  std::vector<Triangle> triangles;     ///< every corner exists and is finite
};

enum class GeometryError : std::uint8_t {
  none,
  no_triangles,  ///< points or lines
  no_positions,  ///< no bytes, or none that can be read
  packed,        ///< the bitstream could not be decoded
  too_large,     ///< beyond the budget
  empty,         ///< nothing is left that has an area
};
/// Why there is nothing to draw, as the end of "primitive 3 ...": "has points or lines only".
std::string_view error_text(GeometryError error);

/// Fills `geometry`. Takes memory only for what the budget allows.
GeometryError read_geometry(const GeometrySource& source, const Primitive& primitive,
                            const GeometryRequest& request, MemoryBudget& budget,
                            Geometry& geometry);

}  // namespace gltfx::model
