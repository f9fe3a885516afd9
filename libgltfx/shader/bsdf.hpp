// SPDX-License-Identifier: Apache-2.0
/// The operators that mix lobes, with the names of the specification (Appendix B and the texts of
/// the material extensions). Nodes hold their operands by value, and refer to the evaluated
/// parameters of the surface (Prepared).
///
/// Decisions where the texts are ambiguous or contradict themselves:
///
/// 1. Half vector of transmitted light: the light is mirrored into the viewer's hemisphere
///    (Directions), for the Fresnel weight of diffuse_btdf too, which the text of
///    KHR_materials_diffuse_transmission leaves open. Then dt 0 and dt 1 reflect alike, and a plane
///    whose two colours are equal looks the same for any factor. The step functions of G_T are read
///    with the mirrored direction; taken literally they would cut the lobe of rough thin walls
///    where its reflected twin is whole.
/// 2. Refraction (KHR_materials_volume) uses H_TR for the lobe and its Fresnel weight. The prose
/// says the angle "on the dense side", its formulas use the thinner side, as Schlick's curve
/// requires: the formulas hold. Total reflection is 1 for all colours.
/// 3. Radiance is not scaled by eta^2 on entering a volume: light that enters leaves again, and the
/// formula of the text is normalised so that the lobe takes 1 - F.
/// 4. Anisotropy turns and stretches specular_btdf like specular_brdf, as "this microfacet lobe is
///    exactly the same". The clamp of V_GGX_anisotropic to 1 is left out: it is not part of the
///    model, and would darken grazing angles only with anisotropy.
/// 5. ior 0 is an infinite IOR: F0 is 1 times the specular colour, dispersion has no effect. (For
/// refraction, for which the mode is not intended, a number so large that light goes straight in.)
/// 6. KHR_materials_subsurface writes sigma_s = (1 - log c) / d in one place and -log(c) / d in the
///    other; the second follows from the definition by Beer's law and is that of its predecessor.
///    A colour of 0 would make a medium infinitely dense: it counts as 1e-6.
/// 7. KHR_materials_scatter at strength 0 says "therefore rho_ss = 0"; the fit gives 6e-6 there.
///    Strength 0 is no scattering.
/// 8. The thin film always has air outside, as in the text, and is below the clearcoat without an
/// interface between. A base of F0 above 0.9999 gets the phase that the text's code gives it.
/// 9. A clearcoat with its own normal is a BRDF about that normal: its cosine replaces that of
///    the base. Clearcoat and sheen cover both sides of a surface.
/// 10. The prose of KHR_materials_diffuse_transmission multiplies the colour texture by the factor
///    of the strength; its formula, by the colour factor: the formula holds. (That is done where
///    textures are read.)
/// 11. A thin film of the index of air or without thickness is none. (The formulas of the text, of
/// which the curve of Schlick always ends at 1, give it a reflection.)
#pragma once

#include <gltfx/material.hpp>

#include "shader/conserving.hpp"
#include "shader/fresnel.hpp"
#include "shader/lobes.hpp"
#include "shader/sheen_scaling.hpp"

namespace gltfx::shader {

/// A rotated frame; no effect when its normal is +z.
struct CoatFrame {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  CoatFrame() = default;
  /// The tangent is as close to +x as possible.
  explicit CoatFrame(const Vec3d& normal) {
    if (normal == Vec3d(0, 0, 1)) return;
    z = normal;
    const Vec3d along = Vec3d(1, 0, 0) - normal.x * normal;
    const Vec3d other = std::fabs(normal.x) < 0.99 ? along : Vec3d(0, 1, 0) - normal.y * normal;
    x = normalize(other);
    y = cross(z, x);
  }
  Vec3d into(const Vec3d& w) const { return {dot(w, x), dot(w, y), dot(w, z)}; }
  Vec3d out_of(const Vec3d& w) const { return w.x * x + w.y * y + w.z * z; }
};

/// The layer of KHR_materials_clearcoat, specular_brdf about its own normal, prepared from v.
struct SeenCoat {
  CoatFrame frame;
  Vec3d v;  ///< in that frame; below its horizon nothing is reflected
  SeenFacets facets;
  MultipleScattering bounces;
  bool hidden = false;  ///< takes no light from the base, as it reflects none

  SeenCoat(const Vec3d& normal, double roughness, const Vec3d& viewer, ShaderMode mode)
      : frame(normal), v(frame.into(viewer)), facets(microfacets(roughness), v) {
    if (mode != ShaderMode::conserving) return;
    hidden = v.z <= 0;
    if (!hidden) bounces = MultipleScattering(facets, v);
  }
};

/// clearcoat_brdf = specular_brdf(normal, alpha). Values are those of a BRDF about +z: they
/// include the cosine to the normal of the coat over that to +z.
struct clearcoat_brdf : Lobe {
  static constexpr int kKinds = kSpecularReflect;
  const SeenCoat& coat;
  specular_brdf brdf;

  /// Keeps a reference to the coat.
  explicit clearcoat_brdf(const SeenCoat& c)
      : Lobe{1, c.facets.smooth()}, coat(c), brdf(c.facets) {}
  Directions in_frame(const Directions& d) const {
    Directions turned(coat.v, coat.frame.into(d.l), d.measure, d.lobes);
    turned.opposite = turned.opposite || d.opposite || coat.v.z <= 0;
    return turned;
  }
  Rgb eval(const Directions& d, const Through& through) const { return evaluate(d, through).f; }
  double pdf(const Directions& d) const { return evaluate(d, {}).pdf; }
  Evaluation evaluate(const Directions& d, const Through& through) const {
    const Directions turned = in_frame(d);
    const Evaluation about_normal = brdf.evaluate(turned, through);
    const double scale = coat.bounces.active() ? coat.bounces.scale(turned.l) : 1;
    const Rgb f = d.l.z > 0 ? about_normal.f * (scale * turned.l.z / d.l.z) : Rgb();
    return {f, f, about_normal.pdf};
  }
  Proposal sample(const Vec3d&, const Random3& r) const {
    if (coat.v.z <= 0) return {{}, Measure::solid_angle, false};
    Proposal p = brdf.sample(coat.v, r);
    p.l = coat.frame.out_of(p.l);
    p.valid = p.valid && p.l.z > 0;
    return p;
  }
};

/// Calls visitor(leaf, probability) for the leaves below a node, except those that are never
/// chosen.
template <class Node, class Visitor>
void visit_node(const Node& node, Visitor& visitor, double probability) {
  if (probability <= 0) return;
  if constexpr (requires { node.visit(visitor, probability); }) {
    node.visit(visitor, probability);
  } else {
    visitor(node, probability);
  }
}

/// Value and density of a node: by its own function, or, for a leaf, one after the other.
template <class Node>
Evaluation evaluate_node(const Node& node, const Directions& d, const Through& through) {
  if constexpr (requires { node.evaluate(d, through); }) {
    return node.evaluate(d, through);
  } else {
    const Rgb value = node.eval(d, through);
    return {value, Node::kKinds == kSpecularReflect ? value : Rgb(), node.pdf(d)};
  }
}

/// The density of a choice between two.
inline double mix_pdf(double pdf0, double pdf1, double chance) {
  return chance <= 0 ? pdf0 : chance >= 1 ? pdf1 : (1 - chance) * pdf0 + chance * pdf1;
}

/// mix(bsdf0, bsdf1, factor) = (1 - factor) * bsdf0 + factor * bsdf1
template <class Bsdf0, class Bsdf1>
struct mix : Lobe {
  Bsdf0 bsdf0;
  Bsdf1 bsdf1;
  double factor;
  double chance;  ///< of sampling bsdf1

  mix(const Bsdf0& a, const Bsdf1& b, double f) : bsdf0(a), bsdf1(b), factor(f) {
    power = (1 - f) * a.power + f * b.power;
    chance = power > 0 ? f * b.power / power : f;
    is_delta = (chance >= 1 || a.is_delta) && (chance <= 0 || b.is_delta);
  }
  Evaluation evaluate(const Directions& d, const Through& through) const {
    const Evaluation a = factor < 1 ? evaluate_node(bsdf0, d, through) : Evaluation();
    const Evaluation b = factor > 0 ? evaluate_node(bsdf1, d, through) : Evaluation();
    return {(1 - factor) * a.f + factor * b.f, (1 - factor) * a.reflected + factor * b.reflected,
            mix_pdf(a.pdf, b.pdf, chance)};
  }
  Proposal sample(const Vec3d& v, Random3 r) const {
    return choose(chance, r.lobe) ? bsdf1.sample(v, r) : bsdf0.sample(v, r);
  }
  template <class Visitor>
  void visit(Visitor& visitor, double probability) const {
    visit_node(bsdf0, visitor, probability * (1 - chance));
    visit_node(bsdf1, visitor, probability * chance);
  }
};

/// conductor_fresnel(f0, bsdf): tints a BSDF by the Fresnel term of a metal;
/// iridescent_conductor_layer with a film.
template <class Bsdf>
struct conductor_fresnel : Lobe {
  const Fresnel& fresnel;
  Bsdf bsdf;
  const TintedBounces& bounces;

  conductor_fresnel(const Fresnel& f, const Bsdf& b, const Vec3d& v, const TintedBounces& s)
      : Lobe{max_value(f.at(v.z)) * b.power, b.is_delta}, fresnel(f), bsdf(b), bounces(s) {}
  Evaluation evaluate(const Directions& d, const Through& through) const {
    const Evaluation value = evaluate_node(bsdf, d, through);
    if (value.f.x == 0) return {{}, {}, value.pdf};
    const Rgb fr = bounces.scaled(fresnel.at(d.v_h), bounces.scale(d.l));
    return {value.f * fr, value.reflected * fr, value.pdf};
  }
  Proposal sample(const Vec3d& v, const Random3& r) const { return bsdf.sample(v, r); }
  template <class Visitor>
  void visit(Visitor& visitor, double probability) const {
    visit_node(bsdf, visitor, probability);
  }
};

/// fresnel_mix(ior, base, layer): the layer reflects by the Fresnel term, the base gets the rest;
/// in the form of KHR_materials_specular, `fr * layer + (1 - max_value(fr)) * base`, and as
/// iridescent_dielectric_layer (rgb_mix) with a film.
template <class Base, class Layer>
struct fresnel_mix : Lobe {
  const Fresnel& fresnel;
  Base base;
  Layer layer;
  const TintedBounces& bounces;
  const EnergyCompensation& held;
  double chance;  ///< of sampling the layer

  fresnel_mix(const Fresnel& f, const Base& b, const Layer& l, const Vec3d& v,
              const TintedBounces& s, const EnergyCompensation& h)
      : fresnel(f), base(b), layer(l), bounces(s), held(h) {
    const Rgb fr = f.at(v.z);
    // Steep facets totally reflect light from the dense side.
    const double total = f.eta < 1 ? l.facets.beyond(f.eta / std::sqrt(1 - square(f.eta))) : 0;
    const double rest = max_value(f.left_over(fr, v.z)) * (1 - total);
    const double reflected = (1 - rest) * l.power;
    const double passed = rest * b.power;
    power = reflected + passed;
    const bool reflects = max_value(f.f90) > 0 || f.eta < 1 || f.film.strength > 0;
    chance = b.power <= 0 ? 1 : reflects ? chance_of(reflected, passed) : 0;
    is_delta = (chance >= 1 || b.is_delta) && (chance <= 0 || l.is_delta);
  }
  Evaluation evaluate(const Directions& d, const Through& through) const {
    const Rgb fr = fresnel.at(d.v_h);
    const Evaluation above = evaluate_node(layer, d, through);
    const double scale = bounces.scale(d.l);
    const Rgb layer_fr = bounces.scaled(fr, scale);
    const Rgb reflected = layer_fr * above.f;
    if (base.power <= 0) return {reflected, layer_fr * above.reflected, above.pdf};
    const Rgb rest = fresnel.left_over(fr, d.v_h);
    Through below{through.diffuse * held.passed(rest, fresnel, d), through.specular * rest * scale};
    if (d.opposite && fresnel.eta != 1) {
      const double cosine = dot(d.v, refraction_half(d, fresnel.eta));
      below.specular = through.specular * fresnel.left_over(fresnel.at(cosine), cosine) * scale;
    }
    const Evaluation passed = evaluate_node(base, d, below);
    return {reflected + passed.f, layer_fr * above.reflected + passed.reflected,
            mix_pdf(passed.pdf, above.pdf, chance)};
  }
  Proposal sample(const Vec3d& v, Random3 r) const {
    return choose(chance, r.lobe) ? layer.sample(v, r) : base.sample(v, r);
  }
  template <class Visitor>
  void visit(Visitor& visitor, double probability) const {
    visit_node(base, visitor, probability * (1 - chance));
    visit_node(layer, visitor, probability * chance);
  }

 private:
  // Facets are inclined: the flat surface gives only an estimate of either part. On the dense side
  // the estimate is bad: some facets reflect totally, and others transmit light where the flat
  // surface would not.
  double chance_of(double reflected, double passed) const {
    const bool dense = fresnel.eta < 1;
    const double let_out = dense && !base.is_delta ? 0.25 * base.power : 0;
    const double guess = reflected / (reflected + std::fmax(passed, let_out));
    if (guess >= 1) return 1;
    const double least = dense ? std::fmin(0.2, layer.facets.widest()) : 0;
    return std::fmin(std::fmax(guess, std::fmax(least, 0.02)), 0.98);
  }
};

/// Sheen on top of a base: the albedo scaling of KHR_materials_sheen.
template <class Base>
struct sheen_layer : Lobe {
  Rgb color;
  sheen_brdf brdf;
  Base base;
  const SheenScaling& scaling;
  double chance;  ///< of sampling the sheen

  sheen_layer(const Rgb& c, const sheen_brdf& s, const Base& b, const SheenScaling& e)
      : color(c), brdf(s), base(b), scaling(e) {
    const double sheen = e.strength() * e.albedo();
    power = sheen + (1 - std::fmin(sheen, 1)) * b.power;
    chance = e.strength() <= 0 ? 0 : std::fmin(std::fmax(sheen / power, 0.02), 1);
    is_delta = chance <= 0 && b.is_delta;
  }
  Evaluation evaluate(const Directions& d, const Through& through) const {
    if (scaling.strength() <= 0) return evaluate_node(base, d, through);
    const Evaluation sheen = evaluate_node(brdf, d, through);
    const SheenScaling::Weights weights = scaling.weights(d.l);
    const Evaluation below = evaluate_node(
        base, d, {through.diffuse * weights.diffuse, through.specular * weights.specular});
    return {color * sheen.f * weights.sheen + below.f,
            color * sheen.reflected * weights.sheen + below.reflected,
            mix_pdf(below.pdf, sheen.pdf, chance)};
  }
  Proposal sample(const Vec3d& v, Random3 r) const {
    return choose(chance, r.lobe) ? brdf.sample(v, r) : base.sample(v, r);
  }
  template <class Visitor>
  void visit(Visitor& visitor, double probability) const {
    visit_node(base, visitor, probability * (1 - chance));
    visit_node(brdf, visitor, probability * chance);
  }
};

/// fresnel_coat(normal, ior, weight, base, layer) of KHR_materials_clearcoat. Its Fresnel term
/// takes the angle to the coat's normal.
template <class Base>
struct fresnel_coat : Lobe {
  Base base;
  clearcoat_brdf layer;
  double fr;      ///< weight times Fresnel
  double chance;  ///< of sampling the layer

  fresnel_coat(double ior, double weight, const Base& b, const clearcoat_brdf& l)
      : base(b),
        layer(l),
        fr(l.coat.hidden ? 0 : weight * schlick(f0_of_ior(ior, 1), std::fabs(l.coat.v.z))) {
    power = fr + (1 - fr) * b.power;
    chance = fr <= 0 ? 0 : fr / power;
    is_delta = (chance >= 1 || b.is_delta) && (chance <= 0 || l.is_delta);
  }
  Evaluation evaluate(const Directions& d, const Through& through) const {
    const Evaluation below = evaluate_node(base, d, through);
    if (fr <= 0) return below;
    const Evaluation coat = evaluate_node(layer, d, through);
    return {(1 - fr) * below.f + fr * coat.f, (1 - fr) * below.reflected + fr * coat.reflected,
            mix_pdf(below.pdf, coat.pdf, chance)};
  }
  Proposal sample(const Vec3d& v, Random3 r) const {
    return choose(chance, r.lobe) ? layer.sample(v, r) : base.sample(v, r);
  }
  template <class Visitor>
  void visit(Visitor& visitor, double probability) const {
    visit_node(base, visitor, probability * (1 - chance));
    visit_node(layer, visitor, probability * chance);
  }
};

}  // namespace gltfx::shader
