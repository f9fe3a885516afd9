// SPDX-License-Identifier: Apache-2.0
#include "shader/lobes.hpp"

namespace gltfx::shader {

double specular_btdf::jacobian(double v_h, double l_h) const {
  if (!refracts) return 1 / (4 * v_h);
  return square(eta) * std::fabs(l_h) / square(v_h + eta * l_h);
}

bool specular_btdf::hits(const Directions& d, Lobes lobe) const {
  return d.transmits(lobe, Measure::delta) && 1 - half(d).z < 1e-12;
}

Rgb specular_btdf::eval(const Directions& d, const Through& through) const {
  if (is_delta) return hits(d, kSpecularTransmit) ? color * (through.specular / d.l.z) : Rgb();
  if (!d.transmits(kSpecularTransmit, Measure::solid_angle)) return {};
  const Vec3d h = half(d);
  const double v_h = dot(d.v, h);
  const double l_h = refracts ? dot(mirrored(d.l), h) : v_h;
  if (v_h <= 0 || (refracts && l_h >= 0)) return {};
  // D G |H.V| / (|N.L| |N.V|) times the Jacobian is the formula of both texts.
  const double g = 4 * (correlated ? facets.visibility(d.v, facets.v_stretched, d.l)
                                   : facets.separable_visibility(d.v, facets.v_stretched, d.l));
  return color * (through.specular * facets.distribution(h) * g * v_h * jacobian(v_h, l_h));
}

double specular_btdf::pdf(const Directions& d) const {
  if (is_delta) return hits(d, kAllLobes) ? 1 : 0;
  if (!d.transmits(kAllLobes, Measure::solid_angle)) return 0;
  const Vec3d h = half(d);
  const double v_h = dot(d.v, h);
  const double l_h = refracts ? dot(mirrored(d.l), h) : v_h;
  if (v_h <= 0 || (refracts && l_h >= 0)) return 0;
  return facets.visible * facets.distribution(h) * v_h * jacobian(v_h, l_h);
}

Proposal specular_btdf::sample(const Vec3d& v, const Random3& r) const {
  const Vec3d h = is_delta ? Vec3d(0, 0, 1) : facets.sample_normal(v, r.u, r.v);
  const Measure measure = is_delta ? Measure::delta : Measure::solid_angle;
  const double v_h = dot(v, h);
  if (!refracts) {
    const Vec3d l = mirrored(2 * v_h * h - v);
    return {l, measure, l.z < 0};
  }
  const double cosine_square = 1 - (1 - square(v_h)) / square(eta);
  if (cosine_square <= 0) return {{}, measure, false};  // total reflection
  const Vec3d l = h * (v_h / eta - std::sqrt(cosine_square)) - v / eta;
  return {l, measure, l.z < 0};
}

}  // namespace gltfx::shader
