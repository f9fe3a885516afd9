// SPDX-License-Identifier: Apache-2.0
/// A material seen from one direction. What does not depend on the light is worked out once, so
/// one object serves all light samples and the continuation of a path at a hit.
#pragma once

#include <gltfx/material.hpp>

#include <optional>
#include <utility>

#include "bake/bsdf.hpp"

namespace gltfx::bake {

/// What the parameters of a surface come to, seen from v (v.z > 0). `eta`: IOR behind the surface
/// over that on the viewer's side.
struct Seen {
  Vec3d v;
  double eta;
  SeenFacets alpha;
  Fresnel ior, metal_f0;
  Held held;
  SheenScaling sheen;
  SeenCoat coat;

  Seen(const Material& m, const Vec3d& viewer, double relative_ior, ShaderMode mode)
      : v(viewer),
        eta(relative_ior),
        alpha(microfacets(m.roughness, m.anisotropy, m.anisotropy_rotation), v),
        ior(dielectric_fresnel(m, m.volumetric() ? eta : 1, mode)),
        metal_f0(metal_fresnel(m, mode)),
        held(held_below(ior, alpha, v, m, mode)),
        sheen(m.sheen_color, m.sheen_roughness, v, mode),
        coat(m.clearcoat_normal, m.clearcoat_roughness, v) {}
};

/// The material as a graph of nodes. They refer to `seen`.
inline auto material_graph(const Material& m, const Seen& seen) {
  const bool volume = m.volumetric();
  const double scatter_strength =
      m.scattering == Scattering::unified && !volume ? m.scatter_strength : 0;

  // clang-format off
  const auto diffuse_bsdf = mix(
      diffuse_brdf(m.base_color),
      diffuse_btdf(m.diffuse_transmission_color),
      m.diffuse_transmission);

  const auto transmitted_bsdf = mix(
      specular_btdf(seen.alpha, volume, seen.eta) * m.base_color,
      scatter_bsdf(m.scatter_color, m.scatter_anisotropy),
      scatter_strength);

  const auto dielectric_brdf = fresnel_mix(
      seen.ior,
      /*base*/ mix(diffuse_bsdf, transmitted_bsdf, m.transmission),
      /*layer*/ specular_brdf(seen.alpha),
      seen.v, seen.held);

  const auto metal_brdf = conductor_fresnel(
      /*f0*/ seen.metal_f0,
      specular_brdf(seen.alpha),
      seen.v);

  const auto material = mix(dielectric_brdf, metal_brdf, m.metallic);

  const auto sheen_material = sheen_layer(
      m.sheen_color,
      sheen_brdf(m.sheen_roughness, seen.v, m.sheen_color),
      material,
      seen.sheen);

  return fresnel_coat(
      /*ior*/ 1.5,
      /*weight*/ m.clearcoat,
      /*base*/ sheen_material,
      /*layer*/ clearcoat_brdf(seen.coat));
  // clang-format on
}

/// Value and density of one direction, as multiple importance sampling needs them together.
struct Evaluation {
  Rgb f;           ///< without the cosine; no delta lobes
  double pdf = 0;  ///< per steradian, of Bsdf::sample()
};

/// Frame, units and options as in <gltfx/material.hpp>. Keeps no reference to the material. Not of
/// use for unlit materials: they only emit.
class Bsdf {
 public:
  Bsdf(const Material& material, const Vec3d& v, const ShaderOptions& options = {});
  Bsdf(const Bsdf&) = delete;
  Bsdf& operator=(const Bsdf&) = delete;

  Evaluation evaluate(const Vec3d& l) const;
  /// The part of evaluate() that is mirrored, glossy or sheen.
  Rgb reflect(const Vec3d& l) const;
  std::optional<MaterialSample> sample(const Random3& random) const;
  /// Below this, Random3::lobe leads to mirrors, gloss and sheen; from it on, to the rest.
  double reflection_chance() const;
  /// Whether all lobes are mirrors or ideal refractions, so that evaluate() gives 0 everywhere.
  bool is_delta() const { return graph_.is_delta; }
  /// Albedo by quadrature, as gltfx::integrate().
  Albedo integrate(int resolution) const;

 private:
  using Graph = decltype(material_graph(std::declval<Material>(), std::declval<Seen>()));

  bool flipped_;  // seen from behind: all is mirrored at the surface
  Seen seen_;
  Graph graph_;
};

}  // namespace gltfx::bake
