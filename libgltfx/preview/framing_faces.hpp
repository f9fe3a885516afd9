// SPDX-License-Identifier: Apache-2.0
/// Triangles of the subject of a picture.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "base/packed.hpp"
#include "preview/framing.hpp"

namespace gltfx::preview {

/// A bounding box that grows.
struct FaceBox {
  Vec3d least = Vec3d(std::numeric_limits<double>::infinity());
  Vec3d greatest = Vec3d(-std::numeric_limits<double>::infinity());

  bool empty() const { return least.x > greatest.x; }
  void add(const Vec3d& p) {
    least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
    greatest = {std::max(greatest.x, p.x), std::max(greatest.y, p.y), std::max(greatest.z, p.z)};
  }
  void add(const FaceBox& other) {
    add(other.least);
    add(other.greatest);
  }
  Vec3d extent() const { return greatest - least; }
  double size() const { return length(greatest - least); }
  double distance(const FaceBox& other) const {
    const Vec3d gap = {std::max({0.0, other.least.x - greatest.x, least.x - other.greatest.x}),
                       std::max({0.0, other.least.y - greatest.y, least.y - other.greatest.y}),
                       std::max({0.0, other.least.z - greatest.z, least.z - other.greatest.z})};
    return length(gap);
  }
};

/// The normal on the front of a face, of twice its area in length.
inline Vec3d area_vector(const Subject& subject, std::size_t face) {
  const Float3* corners = &subject.points[3 * face];
  const Vec3d first = to_vec(corners[0]);
  const Vec3d area = cross(to_vec(corners[1]) - first, to_vec(corners[2]) - first);
  return subject.faces[face].mirrored ? -area : area;
}

/// Removes the faces of which keep(number) is false; it is asked once for each, in order, before
/// that face moves.
template <class Keep>
void keep_faces(Subject& subject, const Keep& keep) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < subject.faces.size(); ++i) {
    if (!keep(i)) continue;
    const auto first = subject.points.begin() + static_cast<std::ptrdiff_t>(3 * i);
    std::copy(first, first + 3, subject.points.begin() + static_cast<std::ptrdiff_t>(3 * kept));
    subject.faces[kept++] = subject.faces[i];
  }
  subject.faces.resize(kept);
  subject.points.resize(3 * kept);
}

}  // namespace gltfx::preview
