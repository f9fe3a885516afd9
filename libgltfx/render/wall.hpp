// SPDX-License-Identifier: Apache-2.0
/// Walls: single-sided opaque surfaces, through which the camera sees and light comes from behind.
///
/// The camera sees such a surface from its front only, so that it looks into a room through the
/// walls that turn their backs to it. Light comes in the same way: a wall that turns its back to
/// both the camera and the light does not occlude the light. All other rays hit walls from both
/// sides: a wall that faces the light casts a shadow.
#pragma once

#include <optional>

#include "render/ray.hpp"
#include "render/scene.hpp"
#include "render/view.hpp"

namespace gltfx::render {

/// The position of the camera: a point, or the direction of an orthographic one.
class Eye {
 public:
  explicit Eye(const View& view)
      : place_(view.perspective ? view.origin : view.backward), weight_(view.perspective ? 1 : 0) {}

  /// Whether a plane through the point turns its back; `normal` points out of its front.
  bool is_behind(const Vec3d& normal, const Vec3d& point) const {
    return dot(normal, place_ - point * weight_) < 0;
  }

 private:
  Vec3d place_;
  double weight_;
};

/// Whether surfaces of the material are walls. Surfaces that are clear or bound a volume are
/// not: they transmit light anyway.
bool is_wall(const SceneMaterial& material);

/// The normal out of the front of the triangle of a hit, by its winding; not of unit length.
Vec3d front_normal(const Scene& scene, const Hit& hit);

/// Whether the surface of a hit turns its back to the eye, or there is no eye.
bool turns_back(const Scene& scene, const Hit& hit, const std::optional<Eye>& eye);

/// Whether light against `direction` passes the surface of a hit: a wall that turns its back to
/// the light, and to the eye if there is one.
bool lets_light_in(const Scene& scene, const Hit& hit, const Vec3d& direction,
                   const std::optional<Eye>& eye);

}  // namespace gltfx::render
