// SPDX-License-Identifier: Apache-2.0
/// A primitive of any mode as plain triangles, segments or points: decompressed, converted to
/// single precision, morphed and skinned to one pose (specification section 3.7).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "model/draco.hpp"
#include "model/elements.hpp"
#include "model/memory_budget.hpp"
#include "model/mesh.hpp"
#include "model/node.hpp"

namespace gltfx::model {

using Triangle = std::array<std::uint32_t, 3>;
using Segment = std::array<std::uint32_t, 2>;

/// The source of accessor elements. All referenced objects must outlive it.
struct GeometrySource {
  const Asset& asset;
  const Views& views;
  const ResourceData& resources;
  const DracoMeshes& draco;
};

/// The vertex data of a primitive, in its own bitstream or in accessors. Keeps references only; the
/// source and the primitive must outlive it.
class PrimitiveData {
 public:
  PrimitiveData(const GeometrySource& source, const Primitive& primitive);

  const GeometrySource& source() const { return source_; }
  const Primitive& primitive() const { return primitive_; }
  /// The decoded bitstream, or null.
  const codec::DracoMesh* packed() const { return packed_; }

  /// The elements of an attribute; nothing when it is missing, cannot be read, or is neither stored
  /// nor sparse (all zeros).
  std::optional<AccessorData> open(SemanticKind kind, std::uint64_t set = 0) const;
  std::optional<AccessorData> open(const Attribute& attribute) const;
  /// The elements of an accessor that is not an attribute of a bitstream.
  std::optional<AccessorData> open(const std::optional<std::uint32_t>& accessor) const;

 private:
  const GeometrySource& source_;
  const Primitive& primitive_;
  std::optional<DracoReference> reference_;
  const codec::DracoMesh* packed_ = nullptr;
};

/// The data to read, and the pose.
struct GeometryRequest {
  std::span<const std::uint32_t> tex_coords;  ///< the n of each TEXCOORD_n to read
  std::span<const float> weights;             ///< of the morph targets; missing ones are 0
  /// Matrices of the skin, from the space of the mesh to that of the scene. Empty: not skinned.
  std::span<const Affine> joints;
  /// Positions that are far from 0 are given relative to Geometry::origin.
  bool near_origin = false;
  bool surface = true;  ///< read normals, tangents and colors
};

/// Lists of vertices have the same length, or are empty without the attribute.
struct Geometry {
  Vectors<3> positions;
  Vectors<3> normals;                  ///< of length 1, or 0 if unknown
  Vectors<4> tangents;                 ///< likewise; w is 1 or -1
  std::vector<Vectors<2>> tex_coords;  ///< as requested
  Vectors<4> colors;                   ///< COLOR_0: linear, from 0 to 1
  Vector3 origin{};                    ///< of the positions, in the space of the mesh
  bool skinned = false;                ///< moved by joints, from then on with the origin 0
  /// Where single precision stores positions in steps of more than a thousandth of their extent,
  /// because they are so far from 0: that step. Else 0.
  double coarse_step = 0;
  // Result of the mode; every vertex exists and is finite.
  std::vector<Triangle> triangles;
  std::vector<Segment> segments;
  std::vector<std::uint32_t> points;
  std::uint64_t collapsed = 0;  ///< triangles that are left out because they have a vertex twice

  /// Whether there is nothing to draw.
  bool empty() const { return triangles.empty() && segments.empty() && points.empty(); }
};

/// Makes triangles, segments or points from indices, one after the other. Those with missing
/// vertices, and those with a repeated vertex and so no area or length, are left out; odd triangles
/// of a strip keep their orientation.
class PrimitiveAssembly {
 public:
  /// `vertices`: their number. An index equal to `restart` begins a new strip, fan or loop
  /// (EXT_mesh_primitive_restart); without that extension, no index does.
  PrimitiveAssembly(Mode mode, std::uint32_t vertices, std::uint32_t restart, Geometry& to)
      : mode_(mode), vertices_(vertices), restart_(restart), to_(to) {}

  void add(std::uint32_t index);
  /// Call it after the last index.
  void finish();

 private:
  void add_to_triangles(std::uint32_t index);
  void add_to_segments(std::uint32_t index);
  void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void emit(std::uint32_t a, std::uint32_t b);

  Mode mode_;
  std::uint32_t vertices_;
  std::uint32_t restart_;
  Geometry& to_;
  std::uint64_t count_ = 0;  ///< indices since the beginning or the last restart
  std::array<std::uint32_t, 2> held_{};
};

/// The number of indices of a primitive with so many vertices.
std::uint64_t index_count(const PrimitiveData& data, std::uint64_t vertices);
/// The index that is no vertex, but begins a new strip, fan or loop.
std::uint32_t restart_index(const PrimitiveData& data);
/// Calls `use` with each index of a primitive in order; without indices, with the number of each
/// vertex. False, and no call: they cannot be read.
template <typename Use>
bool for_each_index(const PrimitiveData& data, std::uint32_t vertices, Use use);

/// Makes the triangles, segments or points of a primitive with so many vertices. False: its indices
/// cannot be read. Preconditions: it has a mode; a budget allows a triangle for each index.
bool assemble(const PrimitiveData& data, std::uint32_t vertices, Geometry& to);

/// Whether the asset may have compressed geometry, of which a byte is worth many.
bool has_compressed_geometry(const json::Document& document);

enum class GeometryError : std::uint8_t {
  none,
  no_positions,  ///< no bytes, or unreadable ones
  no_indices,    ///< likewise
  packed,        ///< the bitstream could not be decoded
  too_large,     ///< beyond the budget
  empty,         ///< no triangle, segment or point is left
};
/// Why there is nothing to draw, as the end of "primitive 3 ...": "has no positions that can be
/// read".
std::string_view error_text(GeometryError error);

/// Fills `geometry`. Takes memory only for what the budget allows.
GeometryError read_geometry(const GeometrySource& source, const Primitive& primitive,
                            const GeometryRequest& request, MemoryBudget& budget,
                            Geometry& geometry);
/// Replaces triangles, segments and points by those of another primitive with the same vertices.
GeometryError read_elements(const GeometrySource& source, const Primitive& primitive,
                            MemoryBudget& budget, Geometry& geometry);

template <typename Use>
bool for_each_index(const PrimitiveData& data, std::uint32_t vertices, Use use) {
  if (const codec::DracoMesh* mesh = data.packed()) {
    for (const std::uint32_t index : mesh->indices) use(index);
    return true;
  }
  if (data.primitive().indices_node == json::kNoNode) {
    for (std::uint32_t i = 0; i < vertices; ++i) use(i);
    return true;
  }
  const auto indices = data.open(data.primitive().indices);
  if (!indices || !can_index_elements(indices->format().component)) return false;
  with_component_type(indices->format().component, [&](auto zero) {
    using T = decltype(zero);
    if constexpr (std::is_unsigned_v<T>) {
      indices->visit<T>([&](const T* values, std::size_t elements, std::uint64_t) {
        for (std::size_t i = 0; i < elements * indices->components(); ++i) use(values[i]);
      });
    }
  });
  return true;
}

}  // namespace gltfx::model
