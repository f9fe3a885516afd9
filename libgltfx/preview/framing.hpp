// SPDX-License-Identifier: Apache-2.0
/// The choice of a view for a scene without cameras.
#pragma once

#include <gltfx/vec3.hpp>

#include <cstdint>
#include <optional>
#include <vector>

#include "render/scene.hpp"
#include "render/view.hpp"

namespace gltfx::preview {

/// A triangle beside its corners.
struct Face {
  std::uint32_t body = 0;  ///< number of its mesh in its instance
  bool mirrored = false;   ///< its corners are clockwise as seen from the front
  bool culled = false;     ///< invisible from behind
  bool clear = false;      ///< what is behind it may be visible
};

/// The subject of a picture: triangles of the scene without strays, and their bounding box.
struct Subject {
  std::vector<Float3> points;  ///< corners, three for each face
  std::vector<Face> faces;
  Vec3d least, greatest;
  bool flat = false;      ///< all faces are parallel
  bool enclosed = false;  ///< a sky around it was left out

  /// Frees the triangles, but not the box, when framing is done.
  void forget_faces();
  Vec3d middle() const { return (least + greatest) * 0.5; }
  /// Length of the box's diagonal in the scene's unit; above 0.
  double size() const;
};

/// Which instances of a scene.
enum class Which : std::uint8_t { all, framed };

/// Nothing if no triangle is visible; alpha of the factors counts. For strays see
/// framing_strays.hpp, for skies and seas framing_surroundings.hpp. Reads a bounded number of
/// triangles.
std::optional<Subject> find_subject(const render::Scene& scene, Which which = Which::all);

/// The side that the camera is on, in degrees. Azimuth 0 is the front (+z), 90 is +x; elevation 90
/// is above.
struct Direction {
  double azimuth = 0, elevation = 0;
};

/// Three quarters from the front and a little from above; more from above for a flat subject. From
/// behind or below if the subject is visible from there only.
Direction usual_direction(const Subject& subject);

/// A camera on that side of the origin, upright.
render::View view_from(const Direction& direction);

/// The view with the subject in the middle, as large as possible with a margin. `aspect`: width by
/// height.
render::View frame(const Subject& subject, const Direction& direction, double aspect);

/// The same with an orthographic camera, in front of all of `scene`.
render::View frame_orthographic(const Subject& subject, const Direction& direction, double aspect,
                                const Subject& scene);

}  // namespace gltfx::preview
