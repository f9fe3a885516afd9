// SPDX-License-Identifier: Apache-2.0
/// Single-sided opaque surfaces: what the camera sees through from behind, and what lets light in.
///
/// The camera sees such a surface from its front only, so that it looks into a room through the
/// walls that turn their backs to it. Light comes in the same way: a wall that turns its back to
/// both the camera and the light is not there for that light. For all else walls are solid on both
/// sides: one that faces the light throws a shadow.
#pragma once

#include <optional>

#include "bake/ray.hpp"
#include "bake/scene.hpp"
#include "bake/view.hpp"

namespace gltfx::bake {

/// From where a picture is taken: a point, or a direction of an orthographic camera.
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

/// Whether surfaces of the material are walls. What is clear or holds a volume lets light through
/// by itself.
bool is_wall(const SceneMaterial& material);

/// Whether what was hit turns its back to the eye, or there is none.
bool turns_back(const Scene& scene, const Hit& hit, const std::optional<Eye>& eye);

/// Whether light that comes against `direction` passes what was hit: a wall that turns its back to
/// the light, and to the eye if there is one.
bool lets_light_in(const Scene& scene, const Hit& hit, const Vec3d& direction,
                   const std::optional<Eye>& eye);

}  // namespace gltfx::bake
