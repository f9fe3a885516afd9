// SPDX-License-Identifier: Apache-2.0
#include "render/surface.hpp"

#include <algorithm>
#include <cmath>

#include "base/fork.hpp"
#include "base/packed.hpp"
#include "render/material_at.hpp"
#include "render/texture.hpp"
#include "render/transform.hpp"
#include "shader/microfacet.hpp"

namespace gltfx::render {
namespace {

// The triangle of a hit. Results are in world space.
class HitTriangle {
 public:
  HitTriangle(const Scene& scene, const Hit& hit)
      : instance_(scene.instances[hit.instance]),
        mesh_(scene.meshes[hit.mesh]),
        corners_(mesh_.triangles[hit.triangle]),
        u_(static_cast<double>(hit.u)),
        v_(static_cast<double>(hit.v)),
        first_(to_vec(mesh_.positions[corners_[0]])),
        along_1_(to_vec(mesh_.positions[corners_[1]]) - first_),
        along_2_(to_vec(mesh_.positions[corners_[2]]) - first_),
        normals_(instance_.to_world) {}

  // From the barycentric coordinates: more exact than the end of the ray.
  Vec3d position() const {
    return transform_point(instance_.to_world, first_ + along_1_ * u_ + along_2_ * v_);
  }

  // Points out of the front; zero without area.
  Vec3d flat_normal() const {
    const Vec3d n = normals_.outward(cross(along_1_, along_2_));
    const double norm = length(n);
    return norm > 0 && std::isfinite(norm) ? n / norm : Vec3d();
  }

  Vec3d smooth_normal(const Vec3d& flat) const {
    if (mesh_.normals.empty()) return flat;
    const Vec3d n = normals_.outward(mean(mesh_.normals));
    const double norm = length(n);
    return norm > 0 && std::isfinite(norm) ? n / norm : flat;
  }

  // The tangent is perpendicular to the normal: the mesh's own, or else along u of the texture
  // coordinates of a slot that needs tangents, or else any.
  Frame frame(const Vec3d& normal, const SceneMaterial& material) const {
    Vec3d tangent;
    double sign = normals_.handedness();
    if (!mesh_.tangents.empty() && !mesh_.normals.empty()) {
      tangent = transform_vector(instance_.to_world, mean(mesh_.tangents));
      if (mesh_.tangents[corners_[0]][3] < 0) sign = -sign;
    } else if (needs_tangents(material)) {
      tangent = along_u(material, normal, sign);
    } else {
      return frame_around(normal);
    }
    tangent = tangent - normal * dot(tangent, normal);
    const double norm = length(tangent);
    if (!(norm > 0) || !std::isfinite(norm)) return frame_around(normal);
    tangent = tangent / norm;
    return {tangent, cross(normal, tangent) * sign, normal};
  }

 private:
  template <std::size_t N>
  Vec3d mean(const SharedArray<std::array<float, N>>& values) const {
    const auto at = [&](std::size_t corner) -> Vec3d {
      const auto& value = values[corners_[corner]];
      return {value[0], value[1], value[2]};
    };
    return at(0) * (1 - u_ - v_) + at(1) * u_ + at(2) * v_;
  }

  static bool needs_tangents(const SceneMaterial& material) {
    return material.factors.anisotropy > 0 || material.use(Slot::normal).texture != kNone ||
           material.use(Slot::clearcoat_normal).texture != kNone;
  }

  // The direction in which u grows on the triangle; `sign` becomes -1 where the texture is mirrored
  // (in glTF v runs down the image, and the bitangent up).
  Vec3d along_u(const SceneMaterial& material, const Vec3d& normal, double& sign) const {
    const TextureUse& use = material.use(Slot::normal).texture != kNone
                                ? material.use(Slot::normal)
                                : material.use(Slot::anisotropy);
    std::array<Float2, 3> uv{};
    if (use.uv_set < mesh_.uvs.size() && !mesh_.uvs[use.uv_set].empty()) {
      for (std::size_t i = 0; i < 3; ++i) {
        uv[i] = transform_uv(use, mesh_.uvs[use.uv_set][corners_[i]]);
      }
    }
    const auto du1 = static_cast<double>(uv[1][0] - uv[0][0]);
    const auto du2 = static_cast<double>(uv[2][0] - uv[0][0]);
    const auto dv1 = static_cast<double>(uv[1][1] - uv[0][1]);
    const auto dv2 = static_cast<double>(uv[2][1] - uv[0][1]);
    const double area = du1 * dv2 - du2 * dv1;
    if (area == 0) return {};
    const Vec3d e1 = transform_vector(instance_.to_world, along_1_);
    const Vec3d e2 = transform_vector(instance_.to_world, along_2_);
    const Vec3d along = (e1 * dv2 - e2 * dv1) / area;
    const Vec3d up = (e1 * du2 - e2 * du1) / area;  // opposite to v
    sign = dot(cross(normal, along), up) < 0 ? -1 : 1;
    return along;
  }

  const Instance& instance_;
  const Mesh& mesh_;
  const std::array<std::uint32_t, 3>& corners_;
  double u_, v_;                     // weights of the second and third corner
  Vec3d first_, along_1_, along_2_;  // in the mesh: a corner, and from there to the others
  NormalTransform normals_;
};

// A shading normal that faces away from the viewer is bent until it is perpendicular to the view
// direction.
Vec3d facing(const Vec3d& normal, const Vec3d& viewer) {
  constexpr double kLeast = 1e-3;
  const double cosine = dot(normal, viewer);
  if (cosine >= kLeast) return normal;
  const Vec3d bent = normal + viewer * (kLeast - cosine);
  const double norm = length(bent);
  return norm > 1e-6 ? bent / norm : viewer;
}

// `normal` turned towards the flat one until the mirror image of the viewer is above the triangle.
Vec3d raised(const Vec3d& normal, const Vec3d& flat, const Vec3d& viewer) {
  const double viewer_z = dot(viewer, flat);
  // The threshold of Cycles: reflections may always be as shallow as the view itself.
  const double least = std::min(0.9 * viewer_z, 0.01);
  if (viewer_z <= 0 || 2 * dot(normal, viewer) * dot(normal, flat) - viewer_z >= least)
    return normal;
  const Vec3d across = normal - flat * dot(normal, flat);
  const double norm = length(across);
  if (!(norm > 1e-9)) return normal;
  // In the plane of both normals, the angles are from the flat one: that of the mirror image is
  // twice that of the normal less that of the viewer.
  const Vec3d x = across / norm;
  const double viewer_x = dot(viewer, x);
  const double part = std::hypot(viewer_x, viewer_z);
  const double angle = (std::atan2(viewer_x, viewer_z) + std::acos(least / part)) / 2;
  return x * std::sin(angle) + flat * std::cos(angle);
}

// The same axes around another normal, also on the other side.
Frame turned(const Frame& frame, const Vec3d& normal) {
  const Vec3d tangent = frame.tangent - normal * dot(frame.tangent, normal);
  const double norm = length(tangent);
  if (!(norm > 1e-6)) return frame_around(normal);
  const Vec3d bitangent = cross(normal, tangent / norm);
  return {tangent / norm, dot(bitangent, frame.bitangent) < 0 ? -bitangent : bitangent, normal};
}

template <class Array>
typename Array::value_type interpolate(const Array& values, const Mesh& mesh, const Hit& hit) {
  const auto& [a, b, c] = mesh.triangles[hit.triangle];
  typename Array::value_type sum{};
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] = values[a][i] * (1 - hit.u - hit.v) + values[b][i] * hit.u + values[c][i] * hit.v;
  }
  return sum;
}

}  // namespace

// T. Duff et al., Building an Orthonormal Basis, Revisited (JCGT 2017).
Frame frame_around(const Vec3d& n) {
  const double sign = std::copysign(1.0, n.z);
  const double a = -1 / (sign + n.z);
  const double b = n.x * n.y * a;
  return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

bool is_unseen_back(const Scene& scene, const Hit& hit, const Surface& surface) {
  return !surface.front && is_culled(material_of(scene, scene.meshes[hit.mesh]));
}

Surface surface_at(const Scene& scene, const Hit& hit, const Ray& ray) {
  const Mesh& mesh = scene.meshes[hit.mesh];
  const SceneMaterial& material = material_of(scene, mesh);
  // Textures first: then data of the triangle need not be kept across calls.
  const SlotReader reader(scene, mesh, material, hit);
  Surface surface{{}, {}, {}, material_at(reader)};
  const auto bump = mapped_normal(reader, Slot::normal);
  const HitTriangle triangle(scene, hit);
  surface.position = triangle.position();
  surface.flat_normal = triangle.flat_normal();
  const bool front = dot(surface.flat_normal, ray.direction) < 0;
  surface.front = front;
  const Vec3d smooth = triangle.smooth_normal(surface.flat_normal);
  if (length(smooth) == 0) return surface;

  const bool inside = surface.material.volumetric() && !front;
  const Vec3d viewer = -ray.direction;
  // First to the side of the viewer, from there to the outside of the surface.
  const double side = front ? 1 : -1;
  const double outward = inside ? -1 : 1;
  const auto oriented = [&](const Vec3d& normal) {
    return facing(normal * side, viewer) * outward;
  };

  const Frame plain = triangle.frame(smooth, material);
  const Vec3d shading = oriented(bump ? plain.to_world(*bump) : smooth);
  surface.frame = shading == smooth ? plain : turned(plain, shading);
  surface.flat_normal *= side * outward;
  if (surface.material.clearcoat > 0) {
    const auto coat = mapped_normal(reader, Slot::clearcoat_normal);
    const Vec3d normal = oriented(coat ? plain.to_world(*coat) : smooth);
    surface.material.clearcoat_normal = surface.frame.to_local(normal);
  }
  return surface;
}

void raise_reflections(Surface& surface, const Vec3d& viewer) {
  const bool inside = dot(surface.flat_normal, viewer) <= 0;  // of a volume
  if (inside || surface.frame.normal == surface.flat_normal) return;
  const bool coated = surface.material.clearcoat > 0;
  const Vec3d coat = coated ? surface.frame.to_world(surface.material.clearcoat_normal) : Vec3d();
  const Vec3d normal = raised(surface.frame.normal, surface.flat_normal, viewer);
  if (!(normal == surface.frame.normal)) surface.frame = turned(surface.frame, normal);
  if (!coated) return;
  surface.material.clearcoat_normal =
      surface.frame.to_local(raised(coat, surface.flat_normal, viewer));
}

const SceneMaterial& material_of(const Scene& scene, const Mesh& mesh) {
  return mesh.material == kNone ? empty_value<SceneMaterial>() : scene.materials[mesh.material];
}

bool has_holes(const SceneMaterial& material) { return material.alpha_mode != AlphaMode::opaque; }

bool is_culled(const SceneMaterial& material) {
  return !material.double_sided && !material.factors.volumetric();
}

bool is_pane(const SceneMaterial& material) {
  const Material& m = material.factors;
  const bool smooth = shader::square(m.roughness) <= shader::kSmoothAlpha;
  const bool may_be_smooth = smooth || material.use(Slot::metallic_roughness).texture != kNone;
  return !m.unlit && m.transmission > 0 && !m.volumetric() && may_be_smooth;
}

Float2 uv_at(const Mesh& mesh, std::uint32_t set, const Hit& hit) {
  if (set >= mesh.uvs.size() || mesh.uvs[set].empty()) return {0, 0};
  return interpolate(mesh.uvs[set], mesh, hit);
}

Float4 color_at(const Mesh& mesh, const Hit& hit) {
  if (mesh.colors.empty()) return {1, 1, 1, 1};
  return interpolate(mesh.colors, mesh, hit);
}

float coverage_at(const Scene& scene, const Mesh& mesh, const SceneMaterial& material,
                  const Hit& hit) {
  float alpha = material.alpha * color_at(mesh, hit)[3];
  const TextureUse& use = material.use(Slot::base_color);
  if (use.texture != kNone) {
    const Float2 uv = transform_uv(use, uv_at(mesh, use.uv_set, hit));
    alpha *= sample_channel(scene.textures[use.texture], uv[0], uv[1], 3);
  }
  if (material.alpha_mode == AlphaMode::mask) return alpha < material.alpha_cutoff ? 0.0F : 1.0F;
  return std::clamp(alpha, 0.0F, 1.0F);
}

}  // namespace gltfx::render
