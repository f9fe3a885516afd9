// SPDX-License-Identifier: Apache-2.0
/// Fewer triangles for one list of indices, within a measured error.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "model/simplify.hpp"
#include "model/surface_distance.hpp"

namespace gltfx::steps {

/// Values of vertices that triangles interpolate.
struct SimplifyValues {
  bool directions = false;  ///< normals; otherwise texture coordinates
  std::vector<std::array<float, 3>> values;
};

/// How far values on the new surface are from those at the same place of the old one.
struct SimplifyDrift {
  double angle = 0;  ///< of normals, in degrees, for all but one of a hundred triangles
  double slide = 0;  ///< of textures along the surface, in the unit of the error, likewise
};

/// A list of triangles to simplify, and the result.
struct SimplifyJob {
  std::vector<std::uint32_t> vertices;          ///< of the set, by the numbers of this list
  std::vector<std::array<float, 3>> positions;  ///< of these vertices
  std::vector<std::uint32_t> same;              ///< the first one with the same position
  std::vector<SimplifyValues> values;
  std::vector<std::uint32_t> corners;      ///< before
  json::NodeId primitive = json::kNoNode;  ///< the first one with the list
  std::uint32_t mesh = 0;                  ///< of it
  double scale = 1;                        ///< from the unit of positions to that of the error
  bool lock_borders = false;               ///< other triangles touch its borders

  std::vector<std::uint32_t> result;  ///< as `corners`; the same: it is left
  double measured = 0;                ///< distance of the surfaces, in the unit of the error
  SimplifyDrift drift;                ///< of values
  std::string why;                    ///< why it is left; empty: it is not

  model::Surface surface() const { return {positions, corners}; }
  bool changes() const { return result.size() < corners.size(); }
};

/// Greatest angle of normals, in degrees, for simplify_within().
inline constexpr double kMostAngle = 15;

/// The fewest triangles whose surface is not farther than `bound` from the old one, both ways, and
/// has no more open edges.
void simplify_within(SimplifyJob& job, double bound, unsigned jobs);

/// As few triangles, of all lists together, with one error for all; measures what that is. Lists
/// that would get more open edges stay.
void simplify_to(std::vector<SimplifyJob>& all, std::uint64_t triangles, unsigned jobs);

}  // namespace gltfx::steps
