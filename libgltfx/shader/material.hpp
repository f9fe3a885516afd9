// SPDX-License-Identifier: Apache-2.0
/// A material prepared from one direction. Values that do not depend on the light are computed once
/// for all light samples and the BSDF sample at a hit.
#pragma once

#include <gltfx/material.hpp>

#include <optional>
#include <utility>

#include "shader/bsdf.hpp"

namespace gltfx::shader {

/// The parameters of a surface, prepared from v (v.z > 0). `eta`: IOR behind the surface
/// over that on the viewer's side.
struct Prepared {
  Vec3d v;
  double eta;
  ShaderMode mode;
  SeenFacets alpha;
  Fresnel ior, metal_f0;
  TintedBounces bounces, metal_bounces;
  EnergyCompensation held;

  Prepared(const Material& m, const Vec3d& viewer, double relative_ior, ShaderMode mode_)
      : v(viewer),
        eta(relative_ior),
        mode(mode_),
        alpha(microfacets(m.roughness, m.anisotropy, m.anisotropy_rotation), v),
        ior(dielectric_fresnel(m, m.volumetric() ? eta : 1, mode)),
        metal_f0(metal_fresnel(m, mode)),
        bounces(dielectric_bounces(ior, alpha, v, m, mode)),
        metal_bounces(conductor_bounces(metal_f0, alpha, v, m, mode)),
        held(held_below(ior, alpha, v, m, bounces, mode)) {}
};

/// The parameters of layers that extensions add on top.
struct PreparedLayers {
  SheenScaling sheen;
  SeenCoat coat;

  PreparedLayers(const Material& m, const Vec3d& v, ShaderMode mode)
      : sheen(m, v, mode), coat(m.clearcoat_normal, m.clearcoat_roughness, v, mode) {}
};

/// Whether a material has only lobes of the core specification.
inline bool is_core(const Material& m) {
  return m.transmission == 0 && m.diffuse_transmission == 0 && m.diffuse_roughness == 0 &&
         max_value(m.sheen_color) <= 0 && m.clearcoat == 0;
}

/// The core material as a graph of nodes (Appendix B). They refer to `prepared`. It equals the
/// graph below if no extension is used, in a third of the time.
// clang-format off
inline auto core_graph(const Material& m, const Prepared& prepared) {
  const auto dielectric_brdf = fresnel_mix(
      prepared.ior,
      /*base*/ diffuse_brdf(m.base_color),
      /*layer*/ specular_brdf(prepared.alpha),
      prepared.v, prepared.bounces, prepared.held);

  const auto metal_brdf = conductor_fresnel(
      /*f0*/ prepared.metal_f0,
      specular_brdf(prepared.alpha),
      prepared.v, prepared.metal_bounces);

  return mix(dielectric_brdf, metal_brdf, m.metallic);
}

/// The material with all extensions as a graph of nodes. They refer to `prepared` and `layers`.
inline auto material_graph(const Material& m, const Prepared& prepared, const PreparedLayers& layers) {
  const bool volume = m.volumetric();
  const double scatter_strength =
      m.scattering == Scattering::unified && !volume ? m.scatter_strength : 0;

  // No text defines rough facets prepared from the dense side.
  const double diffuse_roughness = prepared.ior.eta < 1 ? 0 : m.diffuse_roughness;
  const auto diffuse_bsdf = mix(
      rough_diffuse_brdf(m.base_color, diffuse_roughness, prepared.v),
      rough_diffuse_btdf(m.diffuse_transmission_color, diffuse_roughness, prepared.v),
      m.diffuse_transmission);

  const auto transmitted_bsdf = mix(
      specular_btdf(prepared.alpha, volume, prepared.eta, prepared.mode) * m.base_color,
      scatter_bsdf(m.scatter_color, m.scatter_anisotropy),
      scatter_strength);

  const auto dielectric_brdf = fresnel_mix(
      prepared.ior,
      /*base*/ mix(diffuse_bsdf, transmitted_bsdf, m.transmission),
      /*layer*/ specular_brdf(prepared.alpha),
      prepared.v, prepared.bounces, prepared.held);

  const auto metal_brdf = conductor_fresnel(
      /*f0*/ prepared.metal_f0,
      specular_brdf(prepared.alpha),
      prepared.v, prepared.metal_bounces);

  const auto material = mix(dielectric_brdf, metal_brdf, m.metallic);

  const auto sheen_material = sheen_layer(
      m.sheen_color,
      sheen_brdf(m.sheen_roughness, prepared.v, m.sheen_color),
      material,
      layers.sheen);

  return fresnel_coat(
      /*ior*/ 1.5,
      /*weight*/ m.clearcoat,
      /*base*/ sheen_material,
      /*layer*/ clearcoat_brdf(layers.coat));
}
// clang-format on

struct BsdfSample : MaterialSample {
  Rgb reflected;  ///< part of `weight` that is mirrored, glossy or sheen
};

/// Frame, units and options as in <gltfx/material.hpp>. Keeps no reference to the material. Not for
/// unlit materials, which only emit light.
class Bsdf {
 public:
  Bsdf(const Material& material, const Vec3d& v, const ShaderOptions& options = {});
  Bsdf(const Bsdf&) = delete;
  Bsdf& operator=(const Bsdf&) = delete;

  /// The value without delta lobes.
  Evaluation evaluate(const Vec3d& l) const;
  std::optional<BsdfSample> sample(const Random3& random) const;
  /// The fraction of light from the opposite side that passes straight through thin smooth walls.
  Rgb straight_transmittance() const;
  /// Below this, Random3::lobe leads to mirrors, gloss and sheen; from it on, to the rest.
  double reflection_chance() const;
  /// Whether all lobes are mirrors or ideal refractions, so that evaluate() gives 0 everywhere.
  bool is_delta() const { return core_ ? core_->is_delta : full_->is_delta; }
  /// Albedo by quadrature, as gltfx::integrate().
  Albedo integrate(int resolution) const;

 private:
  using CoreGraph = decltype(core_graph(std::declval<Material>(), std::declval<Prepared>()));
  using Graph = decltype(material_graph(std::declval<Material>(), std::declval<Prepared>(),
                                        std::declval<PreparedLayers>()));
  template <class Nodes>
  std::optional<BsdfSample> sample(const Nodes& graph, const Random3& random) const;

  bool flipped_;  // prepared from behind: everything is mirrored at the surface
  Prepared prepared_;
  std::optional<CoreGraph> core_;  // or else:
  std::optional<PreparedLayers> layers_;
  std::optional<Graph> full_;
};

}  // namespace gltfx::shader
