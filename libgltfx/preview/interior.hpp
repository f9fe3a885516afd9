// SPDX-License-Identifier: Apache-2.0
/// Rooms, and positions of cameras in them.
#pragma once

#include <gltfx/vec3.hpp>

#include <optional>

#include "preview/framing.hpp"
#include "render/bvh.hpp"
#include "render/scene.hpp"
#include "render/view.hpp"

namespace gltfx::preview {

/// Whether a camera around the scene sees a closed room from behind its walls: it is high enough to
/// stand in; many places in it are surrounded by fronts of surfaces, few of which are visible from
/// outside; and the view from outside shows the backs of walls, or plain walls that fill the box
/// and hide several objects. Traces some ten thousand rays if the size fits. Precondition: the
/// subject has its triangles.
bool is_closed_room(const render::Scene& scene, const Subject& subject, const render::Bvh& bvh);

/// A place in the box of the subject, and the side of it that the camera is on.
struct Standpoint {
  Vec3d place;
  Direction direction;
};

/// The place with the best view: at eye level with surfaces all around, or anywhere in the box if
/// there is no such place. Without a direction, the best one, a little from above.
Standpoint find_standpoint(const render::Scene& scene, const Subject& subject,
                           const render::Bvh& bvh, const std::optional<Direction>& direction,
                           double aspect);

/// A wide-angle view. `aspect`: width by height.
render::View look_around(const Standpoint& from, double aspect);

/// The distance up to which objects in a room cast shadows, in the unit of the scene: a part of its
/// least extent.
double shadow_reach(const Subject& subject);

}  // namespace gltfx::preview
