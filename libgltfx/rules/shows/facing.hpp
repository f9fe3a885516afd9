// SPDX-License-Identifier: Apache-2.0
/// Which way triangles face: against normals, and in or out of a closed surface.
#pragma once

#include <gltfx/vec3.hpp>

#include <cstdint>

#include "rules/shows/triangle_reader.hpp"

namespace gltfx::validate {

/// Sums over triangles. They need no memory, so that all triangles of a surface can be summed.
struct Facing {
  double looked = 0;   ///< triangles with an area
  double judged = 0;   ///< those with normals
  double against = 0;  ///< those with normals that point to the back
  double area = 0;
  double volume = 0;        ///< six times the signed volume of the pyramids to an origin
  double gross = 0;         ///< the sum of their absolute values
  double sides = 0;         ///< triangles that face away from the origin, less those towards it
  Vec3d sum;                ///< of normals as long as areas are large; 0: the surface may be closed
  Vec3d directions;         ///< of normals of length 1
  std::uint64_t edges = 0;  ///< 0: each edge runs in both directions equally often

  void add(const Facing& other, double weight);

  /// Whether most triangles are wound against normals.
  bool turned() const;
  /// Whether the surface is closed. Only if all of its triangles were summed.
  bool closed() const { return gross > 0 && edges == 0; }
  bool inward() const { return volume < -kLeastShare * gross; }
  bool outward() const { return volume > kLeastShare * gross; }
  /// From some of the triangles: whether the surface faces outward, in parts of them.
  bool surely_outward(double share) const;
  /// Likewise: whether it is open because most triangles face one way.
  bool surely_open(double share) const;

 private:
  static constexpr double kLeastShare = 0.1;
};

/// Sums up to `most` triangles from all over the surface; all, if those are no more. `normals`: how
/// many of the three of a triangle are read.
Facing sum_some(const TriangleReader& triangles, std::uint64_t most, std::size_t normals,
                const Vec3d& origin);
/// Sums all triangles, and their edges.
Facing sum_all(const TriangleReader& triangles, const Vec3d& origin);

}  // namespace gltfx::validate
