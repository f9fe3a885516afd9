// SPDX-License-Identifier: Apache-2.0
#include "render/wall.hpp"

#include "base/packed.hpp"
#include "render/surface.hpp"
#include "render/transform.hpp"

namespace gltfx::render {
namespace {

struct FacePlane {
  Vec3d point;
  Vec3d normal;  // out of the front, not of unit length
};

FacePlane plane_of(const Scene& scene, const Hit& hit) {
  const Matrix34& to_world = scene.instances[hit.instance].to_world;
  const Mesh& mesh = scene.meshes[hit.mesh];
  const auto& corners = mesh.triangles[hit.triangle];
  const Vec3d a = to_vec(mesh.positions[corners[0]]);
  const Vec3d b = to_vec(mesh.positions[corners[1]]);
  const Vec3d c = to_vec(mesh.positions[corners[2]]);
  return {transform_point(to_world, a), NormalTransform(to_world).outward(cross(b - a, c - a))};
}

}  // namespace

// An unlit surface only shows its color: no factor lets light through it.
bool is_wall(const SceneMaterial& material) {
  const Material& m = material.factors;
  const bool transmits = !m.unlit && (m.transmission > 0 || m.diffuse_transmission > 0);
  return is_culled(material) && !transmits;
}

Vec3d front_normal(const Scene& scene, const Hit& hit) { return plane_of(scene, hit).normal; }

bool turns_back(const Scene& scene, const Hit& hit, const std::optional<Eye>& eye) {
  if (!eye) return true;
  const FacePlane plane = plane_of(scene, hit);
  return eye->is_behind(plane.normal, plane.point);
}

bool lets_light_in(const Scene& scene, const Hit& hit, const Vec3d& direction,
                   const std::optional<Eye>& eye) {
  if (!is_wall(material_of(scene, scene.meshes[hit.mesh]))) return false;
  return dot(plane_of(scene, hit).normal, direction) < 0 && turns_back(scene, hit, eye);
}

}  // namespace gltfx::render
