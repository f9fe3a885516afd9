// SPDX-License-Identifier: Apache-2.0
/// The box of what a scene draws at rest, exact: of its vertices, not of the corners of other
/// boxes.
#pragma once

#include <limits>

#include "base/result.hpp"
#include "model/geometry.hpp"
#include "model/pose.hpp"

namespace gltfx::model {

/// An axis-aligned box; empty until a point is added.
struct Box {
  Vector3 least{kFar, kFar, kFar};
  Vector3 greatest{-kFar, -kFar, -kFar};

  bool empty() const { return !(least[0] <= greatest[0]); }
  void add(const Vector3& point);
  Vector3 center() const;
  /// Length of the diagonal; 0 if it is empty.
  double diagonal() const;

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();
};

/// The box around a box that is moved (J. Arvo, "Transforming axis-aligned bounding boxes", 1990).
Box moved_box(const Affine& transform, const Box& box);

/// The vertices that elements of a mesh draw, without morph targets and skins, in its own space.
/// Returns an Error (half a sentence) if they cannot be read.
Result<Box> mesh_box(const GeometrySource& source, const Mesh& mesh);

/// The vertices that a scene draws, with morph targets, skins and instances, in its space. `pose`:
/// of the scene at rest. Empty: it draws nothing. Returns an Error (half a sentence) if vertices
/// cannot be read, or if there are too many of them. Linear in nodes and vertices; of a mesh whose
/// nodes rotate it, in their product up to a limit.
Result<Box> scene_box(const GeometrySource& source, const Pose& pose);

}  // namespace gltfx::model
