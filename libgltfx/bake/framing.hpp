// SPDX-License-Identifier: Apache-2.0
/// A view of an object nobody has seen yet.
#pragma once

#include <gltfx/vec3.hpp>

#include <optional>
#include <vector>

#include "bake/scene.hpp"
#include "bake/view.hpp"

namespace gltfx::bake {

/// A triangle, as far as its sides matter.
struct Face {
  bool mirrored = false;  ///< its corners are clockwise seen from the front
  bool culled = false;    ///< there is nothing to see of it from behind
};

/// What a scene is about: triangles of its surfaces without those that stray, and the box around
/// them.
struct Subject {
  std::vector<Float3> points;  ///< corners, three for each face
  std::vector<Face> faces;
  Vec3d least, greatest;

  /// Leaves the box, when nothing is to be framed any more.
  void forget_faces();
  Vec3d middle() const { return (least + greatest) * 0.5; }
  /// Length of the box's diagonal in the scene's unit; above 0.
  double size() const;
};

/// Nothing when there is nothing to see; what alpha makes invisible everywhere is nothing. What
/// strays is told in framing_strays.hpp. Looks at a bounded number of triangles.
std::optional<Subject> find_subject(const Scene& scene);

/// From where to look: degrees. Azimuth 0 looks at the front (+z), 90 at the side of +x; elevation
/// 90 looks from above.
struct Direction {
  double azimuth = 0, elevation = 0;
};

/// Three quarters from the front and a little from above; more from above what is flat. From behind
/// or below where only there something is to be seen.
Direction usual_direction(const Subject& subject);

/// The view that has the subject in its middle, as large as it goes with a margin. `aspect`: width
/// by height.
View frame(const Subject& subject, const Direction& direction, double aspect);

}  // namespace gltfx::bake
