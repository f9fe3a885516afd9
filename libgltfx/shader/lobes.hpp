// SPDX-License-Identifier: Apache-2.0
/// The leaves of the material: BRDFs and BTDFs, with the names of the specification.
///
/// Each has eval (the value, without the cosine), sample (a direction) and pdf (the density of it);
/// `power`, an estimate of its albedo by which mixtures choose; `is_delta`, whether it has no
/// width; `kKinds`, the kinds of its light.
#pragma once

#include "shader/microfacet.hpp"

namespace gltfx::shader {

/// Members of all leaves.
struct Lobe {
  double power;
  bool is_delta;

  explicit Lobe(double power_ = 0, bool delta = false) : power(power_), is_delta(delta) {}
};

/// diffuse_brdf(color): Lambert.
struct diffuse_brdf : Lobe {
  static constexpr int kKinds = kDiffuseReflect;
  Rgb color;

  explicit diffuse_brdf(const Rgb& c) : Lobe{max_value(c)}, color(c) {}
  Rgb eval(const Directions& d, const Through& through) const {
    if (!d.reflects(kDiffuseReflect, Measure::solid_angle)) return {};
    return color * (through.diffuse * inv_pi);
  }
  double pdf(const Directions& d) const {
    return d.reflects(kAllLobes, Measure::solid_angle) ? d.l.z * inv_pi : 0;
  }
  Proposal sample(const Vec3d&, const Random3& r) const { return {cosine_hemisphere(r.u, r.v)}; }
};

/// Lambert's law for a rough surface of V-shaped cavities, for
/// KHR_materials_diffuse_roughness: EON, the model of OpenPBR, which the text names. It is Fujii's
/// form of the model of Oren and Nayar, plus multiple bounces: white loses no energy. (J.
/// Portsmouth, P. Kutz and S. Hill, EON: A Practical Energy-Preserving Rough Diffuse BRDF, Journal
/// of Computer Graphics Techniques 14(1), 2025.)
class Cavities {
 public:
  Cavities(double roughness, const Vec3d& v)
      : roughness_(roughness),
        a_(1 / (1 + (0.5 - 2 * inv_pi / 3) * roughness)),
        mean_(a_ * (1 + (2.0 / 3 - 28 * inv_pi / 15) * roughness)),
        kept_v_(roughness > 0 ? kept(v.z) : 0) {}

  /// The BRDF times pi of facets of a colour: that colour where it is smooth.
  Rgb tint(const Rgb& color, const Directions& d) const {
    if (roughness_ <= 0) return color;
    const double s = dot(d.v, d.l) - d.v.z * d.l.z;
    const double once = a_ * (1 + roughness_ * (s > 0 ? s / std::fmax(d.v.z, d.l.z) : s));
    const double again = mean_ * kept_v_ * kept(d.l.z) / (1 - mean_);
    return color * (Rgb(once) + again * color / (Rgb(1) - (1 - mean_) * color));
  }

 private:
  // The fraction of light that does not leave white facets at the first bounce: 1 minus the albedo.
  double kept(double cosine) const {
    const double sine = std::sqrt(std::fmax(0.0, 1 - square(cosine)));
    const double ends = cosine * (1 + sine + square(sine)) / (1 + sine);  // (1 - sine^3) / cosine
    const double g =
        sine * (std::acos(std::fmin(cosine, 1.0)) - sine * cosine + 2.0 / 3 * (ends - 1));
    return 1 - a_ * (1 + roughness_ * inv_pi * g);
  }

  double roughness_;
  double a_, mean_;  ///< A of the model, and the mean albedo of the first bounce
  double kept_v_;
};

/// diffuse_brdf of a rough surface.
struct rough_diffuse_brdf : diffuse_brdf {
  Cavities cavities;

  rough_diffuse_brdf(const Rgb& c, double roughness, const Vec3d& v)
      : diffuse_brdf(c), cavities(roughness, v) {}
  Rgb eval(const Directions& d, const Through& through) const {
    if (!d.reflects(kDiffuseReflect, Measure::solid_angle)) return {};
    return cavities.tint(color, d) * (through.diffuse * inv_pi);
  }
};

/// diffuse_btdf(color) of a rough surface, or of a smooth one: the same lobe on the other side,
/// because the text bases diffuse transmission on it.
struct rough_diffuse_btdf : Lobe {
  static constexpr int kKinds = kDiffuseTransmit;
  Rgb color;
  Cavities cavities;

  rough_diffuse_btdf(const Rgb& c, double roughness, const Vec3d& v)
      : Lobe{max_value(c)}, color(c), cavities(roughness, v) {}
  Rgb eval(const Directions& d, const Through& through) const {
    if (!d.transmits(kDiffuseTransmit, Measure::solid_angle)) return {};
    return cavities.tint(color, d) * (through.diffuse * inv_pi);
  }
  double pdf(const Directions& d) const {
    return d.transmits(kAllLobes, Measure::solid_angle) ? d.l.z * inv_pi : 0;
  }
  Proposal sample(const Vec3d&, const Random3& r) const {
    return {mirrored(cosine_hemisphere(r.u, r.v))};
  }
};

/// specular_brdf(alpha): a microfacet BRDF; a mirror when it is smooth.
struct specular_brdf : Lobe {
  static constexpr int kKinds = kSpecularReflect;
  const SeenFacets& facets;

  /// Keeps a reference to the facets.
  explicit specular_brdf(const SeenFacets& f) : Lobe{1, f.smooth()}, facets(f) {}
  Rgb eval(const Directions& d, const Through& through) const { return evaluate(d, through).f; }
  double pdf(const Directions& d) const { return evaluate(d, {}).pdf; }
  /// Value and density together: they share the distribution of the facets.
  Evaluation evaluate(const Directions& d, const Through& through) const {
    if (is_delta) return mirror(d, through);
    if (!d.reflects(kAllLobes, Measure::solid_angle)) return {};
    const double distribution = facets.distribution(d.h);
    const double pdf = distribution * facets.visible / 4;
    if ((d.lobes & kSpecularReflect) == 0) return {{}, {}, pdf};
    const double visibility = facets.visibility(d.v, facets.v_stretched, d.l);
    const Rgb f = distribution * visibility * through.specular;
    return {f, f, pdf};
  }
  Proposal sample(const Vec3d& v, const Random3& r) const {
    if (is_delta) return {{-v.x, -v.y, v.z}, Measure::delta};
    const Vec3d h = facets.sample_normal(v, r.u, r.v);
    const Vec3d l = 2 * dot(v, h) * h - v;
    return {l, Measure::solid_angle, l.z > 0};
  }

 private:
  Evaluation mirror(const Directions& d, const Through& through) const {
    if (!d.reflects(kAllLobes, Measure::delta) || 1 - d.h.z >= 1e-12) return {};
    const Rgb f = (d.lobes & kSpecularReflect) != 0 ? through.specular / d.v.z : Rgb();
    return {f, f, 1};
  }
};

/// specular_btdf(alpha) of a thin wall (KHR_materials_transmission), and the refracting one of a
/// volume's boundary (KHR_materials_volume; B. Walter et al., Microfacet Models for Refraction
/// through Rough Surfaces, 2007). Tinted: `specular_btdf * color`.
struct specular_btdf : Lobe {
  static constexpr int kKinds = kSpecularTransmit;
  const SeenFacets& facets;
  double eta;  ///< IOR on the light's side over that on the viewer's; 1: nothing is refracted
  bool refracts;
  /// Masking and shadowing as in specular_brdf, so that both together can be made to lose nothing.
  bool correlated;
  Rgb color{1, 1, 1};

  /// `volume`: the surface bounds one. A boundary between equal media has no effect on light, at
  /// any roughness. Keeps a reference to the facets.
  specular_btdf(const SeenFacets& f, bool volume, double relative_ior, ShaderMode mode)
      : Lobe{1, f.smooth() || (volume && std::fabs(relative_ior - 1) < 1e-9)},
        facets(f),
        eta(relative_ior),
        refracts(volume && std::fabs(relative_ior - 1) >= 1e-9),
        correlated(mode == ShaderMode::conserving) {}
  specular_btdf operator*(const Rgb& tint) const {
    specular_btdf tinted = *this;
    tinted.color = tint;
    tinted.power = max_value(tint);
    return tinted;
  }

  /// Half vector of a pair of directions on the viewer's side: H_T, or H_TR.
  Vec3d half(const Directions& d) const { return refracts ? refraction_half(d, eta) : d.h; }
  Rgb eval(const Directions& d, const Through& through) const;
  double pdf(const Directions& d) const;
  Proposal sample(const Vec3d& v, const Random3& r) const;

 private:
  bool hits(const Directions& d, Lobes lobe) const;
  /// Density of directions over density of normals.
  double jacobian(double v_h, double l_h) const;
};

/// scatter_bsdf(color, g) of KHR_materials_scatter: Lambert on both sides.
struct scatter_bsdf : Lobe {
  static constexpr int kKinds = kDiffuseReflect | kDiffuseTransmit;
  Rgb color;
  double forward;

  scatter_bsdf(const Rgb& c, double g) : Lobe{max_value(c)}, color(c), forward((1 + g) / 2) {}
  Rgb eval(const Directions& d, const Through& through) const {
    if (d.measure != Measure::solid_angle) return {};
    if ((d.lobes & (d.opposite ? kDiffuseTransmit : kDiffuseReflect)) == 0) return {};
    return color * ((d.opposite ? forward : 1 - forward) * through.diffuse * inv_pi);
  }
  double pdf(const Directions& d) const {
    if (d.measure != Measure::solid_angle) return 0;
    return (d.opposite ? forward : 1 - forward) * d.l.z * inv_pi;
  }
  Proposal sample(const Vec3d&, const Random3& r) const {
    double u = r.u;
    const bool onwards = choose(forward, u);
    const Vec3d l = cosine_hemisphere(u, r.v);
    return {onwards ? mirrored(l) : l};
  }
};

/// sheen_brdf: upright fibres. Sampled uniformly over the hemisphere, because it is strongest at
/// grazing angles. That makes the rim of a smooth sheen noisy: at roughness 0.15 a sample deviates
/// by 1.5 to 1.8 of the mean. With cosines that are squares of even numbers it is 1.2 to 1.5, with
/// half vectors by the distribution 1.05 to 1.4, but from roughness 0.5 on both are noisier.
struct sheen_brdf : Lobe {
  static constexpr int kKinds = kSpecularReflect;
  Fibres fibres;
  double lambda_v;
  double n_v;

  sheen_brdf(double sheen_roughness, const Vec3d& v, const Rgb& color)
      : Lobe{max_value(color)},
        fibres(sheen_roughness),
        lambda_v(power > 0 ? fibres.lambda(v.z) : 0),
        n_v(v.z) {}
  Rgb eval(const Directions& d, const Through& through) const {
    if (!d.reflects(kSpecularReflect, Measure::solid_angle) || d.l.z <= 0) return {};
    return fibres.distribution(d.h.z) * fibres.visibility(n_v, lambda_v, d.l.z) * through.specular;
  }
  double pdf(const Directions& d) const {
    return d.reflects(kAllLobes, Measure::solid_angle) ? inv_pi / 2 : 0;
  }
  Proposal sample(const Vec3d&, const Random3& r) const { return {uniform_hemisphere(r.u, r.v)}; }
};

}  // namespace gltfx::shader
