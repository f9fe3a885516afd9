// SPDX-License-Identifier: Apache-2.0
/// Surfaces at hits: position, orientation and material, alpha, and the culling of back faces.
#pragma once

#include <gltfx/material.hpp>

#include "render/ray.hpp"
#include "render/scene.hpp"

namespace gltfx::render {

/// The local axes of a surface in world space: orthonormal, of either handedness.
struct Frame {
  Vec3d tangent{1, 0, 0}, bitangent{0, 1, 0}, normal{0, 0, 1};

  Vec3d to_local(const Vec3d& v) const {
    return {dot(v, tangent), dot(v, bitangent), dot(v, normal)};
  }
  Vec3d to_world(const Vec3d& v) const { return tangent * v.x + bitangent * v.y + normal * v.z; }
};

/// Any axes with a normal of unit length.
Frame frame_around(const Vec3d& normal);

struct Surface {
  Vec3d position;
  /// The normal of the flat triangle, on the side of `frame.normal`; unit length. Zero for a
  /// triangle without area, which reflects no light.
  Vec3d flat_normal;
  /// The shading frame, normal map included. The normal is on the outside of a volume, and of all
  /// other surfaces on the side of the viewer.
  Frame frame;
  Material material;
  bool front = true;  ///< the ray came from the front
};

/// Whether objects behind a surface of the material may be seen sharply.
inline bool may_be_clear(const Material& m) {
  return m.transmission > 0.05 && m.metallic < 0.5 && m.roughness < 0.25;
}

/// Whether light goes through surfaces of the material.
inline bool is_transmissive(const Material& m) {
  return m.transmission > 0 || m.diffuse_transmission > 0;
}

/// The albedo of scattering to both sides.
inline Rgb scattering_color(const Material& m) {
  return m.base_color * (1 - m.diffuse_transmission) +
         m.diffuse_transmission_color * m.diffuse_transmission;
}

/// Whether a ray hit the back of a single-sided surface, which emits and reflects no light.
bool is_unseen_back(const Scene& scene, const Hit& hit, const Surface& surface);

/// Whether light may come straight through surfaces of the material: thin walls that are smooth
/// somewhere.
bool is_pane(const SceneMaterial& material);

Surface surface_at(const Scene& scene, const Hit& hit, const Ray& ray);

/// Turns the shading normals of a surface towards the flat one where they send the mirror image of
/// the viewer below the triangle, just far enough that it is above: interpolated and mapped normals
/// then show reflections and no black rings. `viewer`: to the start of the ray, in world space.
/// (The rule and its threshold are those of ensure_valid_specular_reflection() in Cycles.)
void raise_reflections(Surface& surface, const Vec3d& viewer);

/// The material of a mesh, or the default one.
const SceneMaterial& material_of(const Scene& scene, const Mesh& mesh);

/// Whether alpha can make holes in surfaces of the material.
bool has_holes(const SceneMaterial& material);

/// Whether rays from behind pass through surfaces of the material. The surface of a volume always
/// has two sides, independent of `doubleSided`: light must be able to leave it.
bool is_culled(const SceneMaterial& material);

/// Texture coordinates and vertex colour at a hit; zeros and ones where the mesh has none.
Float2 uv_at(const Mesh& mesh, std::uint32_t set, const Hit& hit);
Float4 color_at(const Mesh& mesh, const Hit& hit);

/// The coverage at a hit by alpha and alphaMode, from 0 (a hole) to 1 (solid).
float coverage_at(const Scene& scene, const Mesh& mesh, const SceneMaterial& material,
                  const Hit& hit);

}  // namespace gltfx::render
