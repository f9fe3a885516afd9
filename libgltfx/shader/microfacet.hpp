// SPDX-License-Identifier: Apache-2.0
/// Distributions of facets and fibres. Microfacets: Trowbridge-Reitz (GGX) with the Smith profile,
/// isotropic and anisotropic (Appendix B, KHR_materials_transmission, KHR_materials_anisotropy; E.
/// Heitz, Understanding the Masking-Shadowing Function, JCGT 2014). Fibres of KHR_materials_sheen:
/// the "Charlie" distribution and its visibility (A. Conty and C. Kulla, Production Friendly
/// Microfacet Sheen BRDF, 2017).
#pragma once

#include "shader/directions.hpp"

namespace gltfx::shader {

/// Below this alpha (roughness 0.01) a lobe is narrower than a pixel of any picture, and counts as
/// a mirror, which Appendix B requires at 0.
inline constexpr double kSmoothAlpha = 1e-4;

struct Microfacets {
  double alpha_t = 1, alpha_b = 1;  ///< along and across the direction of anisotropy
  double cosine = 1, sine = 0;      ///< that direction, from the tangent
  bool isotropic() const { return alpha_t == alpha_b; }
  double widest() const { return std::fmax(alpha_t, alpha_b); }
  bool smooth() const { return alpha_b <= kSmoothAlpha && alpha_t <= kSmoothAlpha; }

  Vec3d turned(const Vec3d& w) const {
    if (isotropic()) return w;
    return {cosine * w.x + sine * w.y, cosine * w.y - sine * w.x, w.z};
  }
  Vec3d turned_back(const Vec3d& w) const {
    if (isotropic()) return w;
    return {cosine * w.x - sine * w.y, cosine * w.y + sine * w.x, w.z};
  }

  /// D, in a form with one division.
  double distribution(const Vec3d& half) const {
    const Vec3d h = turned(half);
    const double a = alpha_t * alpha_b;
    const double sum = square(alpha_b * h.x) + square(alpha_t * h.y) + square(a * h.z);
    return a * a * a / (pi * square(sum));
  }

  /// The fraction of the facets, by projected area, whose slope is above `tangent`.
  double beyond(double tangent) const {
    return alpha_t * alpha_b / (alpha_t * alpha_b + square(tangent));
  }

  /// alpha in the plane of the normal and a direction; of the normal, the wider one.
  double under_azimuth(const Vec3d& direction) const {
    const Vec3d w = turned(direction);
    const double across = square(w.x) + square(w.y);
    if (!(across > 0)) return alpha_t;
    return std::sqrt((square(alpha_t * w.x) + square(alpha_b * w.y)) / across);
  }

  /// sqrt(alpha^2 + (1 - alpha^2) (N.w)^2) of the texts.
  double stretched(const Vec3d& direction) const {
    const Vec3d w = turned(direction);
    return std::sqrt(square(alpha_t * w.x) + square(alpha_b * w.y) + square(w.z));
  }

  /// Height-correlated masking and shadowing over 4 |N.L| |N.V|.
  double visibility(const Vec3d& v, double v_stretched, const Vec3d& l) const {
    return 0.5 / (l.z * v_stretched + v.z * stretched(l));
  }
  /// The separable form over 4 |N.L| |N.V|.
  double separable_visibility(const Vec3d& v, double v_stretched, const Vec3d& l) const {
    return 1 / ((l.z + stretched(l)) * (v.z + v_stretched));
  }

  /// A normal with the density of SeenFacets::visible (J. Dupuy and A. Benyoub, Sampling Visible
  /// GGX Normals with Spherical Caps, 2023).
  Vec3d sample_normal(const Vec3d& viewer, double u, double v) const {
    const Vec3d w = turned(viewer);
    const Vec3d stretch = normalize({alpha_t * w.x, alpha_b * w.y, w.z});
    const double z = (1 - u) * (1 + stretch.z) - stretch.z;
    const double radius = std::sqrt(std::fmax(0.0, 1 - z * z));
    const SinCos turn = sin_cos_of(v);
    const Vec3d cap(radius * turn.cosine + stretch.x, radius * turn.sine + stretch.y,
                    z + stretch.z);
    return turned_back(normalize({alpha_t * cap.x, alpha_b * cap.y, std::fmax(1e-12, cap.z)}));
  }
};

/// Microfacets prepared from v: values that do not depend on the light.
struct SeenFacets : Microfacets {
  double v_stretched;
  double visible;  ///< density of normals over the distribution and v.h

  SeenFacets(const Microfacets& facets, const Vec3d& v)
      : Microfacets(facets), v_stretched(stretched(v)), visible(2 / (v.z + v_stretched)) {}
};

/// KHR_materials_anisotropy: alpha along the direction grows, the other is that of the material.
inline Microfacets microfacets(double roughness, double anisotropy = 0, double rotation = 0) {
  const double alpha = square(roughness);
  if (anisotropy == 0) return {alpha, alpha, 1, 0};
  const double along = alpha + (1 - alpha) * square(anisotropy);
  return {along, std::fmax(alpha, kSmoothAlpha), std::cos(rotation), std::sin(rotation)};
}

/// The distribution of fibres is undefined at roughness 0: a lower roughness counts as this.
inline constexpr double kLeastSheenRoughness = 0.0316227766016838;

struct Fibres {
  double alpha;

  explicit Fibres(double sheen_roughness) : alpha(std::fmax(square(sheen_roughness), 1e-3)) {}

  double distribution(double n_h) const {
    const double inverse = 1 / alpha;
    const double sine_square = std::fmax(0.0, 1 - square(n_h));
    return (2 + inverse) * std::pow(sine_square, inverse * 0.5) / (2 * pi);
  }

  double lambda(double cosine) const {
    return cosine < 0.5 ? std::exp(curve(cosine)) : std::exp(2 * curve(0.5) - curve(1 - cosine));
  }

  double visibility(double n_v, double lambda_v, double n_l) const {
    return 1 / ((1 + lambda_v + lambda(n_l)) * (4 * n_v * n_l));
  }

 private:
  double curve(double x) const {
    const double m = square(1 - alpha);
    const auto fit = [m](double rough, double smooth) { return rough + (smooth - rough) * m; };
    return fit(21.5473, 25.3245) /
               (1 + fit(3.82987, 3.32435) * std::pow(x, fit(0.19823, 0.16801))) +
           fit(-1.97760, -1.27393) * x + fit(-4.32054, -4.85967);
  }
};

}  // namespace gltfx::shader
