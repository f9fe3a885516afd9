// SPDX-License-Identifier: Apache-2.0
/// A primitive as plain triangles, segments or points, whatever its mode: decompressed, converted
/// to single precision, morphed and skinned to one pose (specification section 3.7).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "model/draco.hpp"
#include "model/elements.hpp"
#include "model/memory_budget.hpp"
#include "model/mesh.hpp"
#include "model/node.hpp"

namespace gltfx::model {

using Triangle = std::array<std::uint32_t, 3>;
using Segment = std::array<std::uint32_t, 2>;

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
  std::optional<AccessorData> open(const Attribute& attribute) const;
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
  // What the mode makes of them; every vertex exists and is finite.
  std::vector<Triangle> triangles;
  std::vector<Segment> segments;
  std::vector<std::uint32_t> points;

  /// Whether there is nothing to draw.
  bool empty() const { return triangles.empty() && segments.empty() && points.empty(); }
};

/// Takes indices one after the other and makes triangles, segments or points of them. Those of
/// vertices that do not exist, and those that have one vertex twice and so no area or length, are
/// left out; an odd triangle in a strip keeps its front in front.
class PrimitiveAssembly {
 public:
  /// `vertices`: how many there are. An index equal to `restart` begins a new strip, fan or loop
  /// (EXT_mesh_primitive_restart); in files without that extension there is none.
  PrimitiveAssembly(Mode mode, std::uint32_t vertices, std::uint32_t restart, Geometry& to)
      : mode_(mode), vertices_(vertices), restart_(restart), to_(to) {}

  void add(std::uint32_t index);
  /// After the last index.
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

enum class GeometryError : std::uint8_t {
  none,
  no_positions,  ///< no bytes, or none that can be read
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

}  // namespace gltfx::model
