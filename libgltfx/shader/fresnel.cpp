// SPDX-License-Identifier: Apache-2.0
#include "shader/fresnel.hpp"

#include <algorithm>

namespace gltfx::shader {
namespace {

// XYZ of a spectrum that oscillates with the phase shift, from fits to the colour matching
// functions in Fourier space (L. Belcour and P. Barla, A Practical Extension to Microfacet Theory
// for the Modeling of Varying Iridescence, 2017), in Rec. 709.
Rgb sensitivity(double path_difference, const Rgb& shift) {
  const double phase = 2 * pi * path_difference * 1e-9;
  const auto lobe = [&](double value, double position, double variance, double offset) {
    return value * std::sqrt(2 * pi * variance) * std::cos(position * phase + offset) *
           std::exp(-square(phase) * variance);
  };
  const double x = lobe(5.4856e-13, 1.6810e+06, 4.3278e+09, shift.x) +
                   lobe(9.7470e-14, 2.2399e+06, 4.5282e+09, shift.x);
  const double y = lobe(4.4201e-13, 1.7953e+06, 9.3046e+09, shift.y);
  const double z = lobe(5.2481e-13, 2.2084e+06, 6.6121e+09, shift.z);
  const Rgb rgb(3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
                -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
                0.0556434 * x - 0.2040259 * y + 1.0572252 * z);
  return rgb / 1.0685e-7;
}

// One colour of the interface between film and base.
struct BaseInterface {
  double reflectance;  // at the angle inside the film
  double phase;        // shift on reflection
};

// The base's IOR is (1 + r) / (1 - r), which is infinite or negative for a base that reflects all.
BaseInterface base_interface(double film_ior, double base_f0, double cosine) {
  const double r = std::sqrt(base_f0 + 0.0001);  // the guard of the text
  const double above = 1 + r;
  const double below = film_ior * (1 - r);
  const double shift = r != 1 && (r > 1 || above < below) ? pi : 0;
  return {schlick(square((above - below) / (above + below)), cosine), shift};
}

}  // namespace

Rgb iridescent_fresnel(double outside_ior, double film_ior, const Rgb& base_f0, double thickness,
                       double cosine) {
  const double cosine2_square = 1 - square(outside_ior / film_ior) * (1 - square(cosine));
  if (cosine2_square < 0) return Rgb(1);
  const double cosine2 = std::sqrt(cosine2_square);

  const double r12 = schlick(f0_of_ior(film_ior, outside_ior), cosine);
  const double t121 = 1 - r12;
  const double phi21 = film_ior < outside_ior ? 0 : pi;
  const double path_difference = 2 * film_ior * thickness * cosine2;

  const BaseInterface x = base_interface(film_ior, base_f0.x, cosine2);
  const BaseInterface y = base_interface(film_ior, base_f0.y, cosine2);
  const BaseInterface z = base_interface(film_ior, base_f0.z, cosine2);
  const Rgb r23(x.reflectance, y.reflectance, z.reflectance);
  const Rgb phi(phi21 + x.phase, phi21 + y.phase, phi21 + z.phase);

  const auto bounded = [](double r) { return std::clamp(r, 1e-5, 0.9999); };
  const Rgb r123(bounded(r12 * r23.x), bounded(r12 * r23.y), bounded(r12 * r23.z));
  const Rgb root(std::sqrt(r123.x), std::sqrt(r123.y), std::sqrt(r123.z));
  const Rgb rs = square(t121) * r23 / (Rgb(1) - r123);
  Rgb sum = Rgb(r12) + rs;
  Rgb cm = rs - Rgb(t121);
  for (const double m : {1.0, 2.0}) {
    cm *= root;
    sum += cm * (2 * sensitivity(m * path_difference, m * phi));
  }
  return {std::max(sum.x, 0.0), std::max(sum.y, 0.0), std::max(sum.z, 0.0)};
}

double film_presence(double ior, double thickness) {
  // Ramps instead of steps, for textures. The thickness at which the sample renderer of Khronos
  // lets a film begin, and an index that only rare gases under pressure go below.
  constexpr double kThickness = 0.03;
  constexpr double kIndex = 0.01;
  const auto ramp = [](double x) {
    const double t = std::clamp(x, 0.0, 1.0);
    return t * t * (3 - 2 * t);
  };
  return ramp(thickness / kThickness) * ramp((ior - 1) / kIndex);
}

Rgb Fresnel::iridescent(double cosine) const {
  const Rgb f = iridescent_fresnel(1, film.ior, f0, film.thickness, cosine);
  return film.conserving ? Rgb(std::min(f.x, 1.0), std::min(f.y, 1.0), std::min(f.z, 1.0)) : f;
}

Rgb Fresnel::inside_or_iridescent(double cosine) const {
  if (eta < 1) {  // Schlick's curve uses the angle in the thinner medium
    const double sine_square = (1 - square(cosine)) / square(eta);
    if (sine_square >= 1) return Rgb(1);  // total reflection, independent of `specular`
    cosine = std::sqrt(1 - sine_square);
  }
  const Rgb plain = schlick(f0, f90, cosine);
  if (film.strength <= 0) return plain;
  return plain * (1 - film.strength) + iridescent(cosine) * film.strength;
}

Rgb Fresnel::left_by_film(const Rgb& reflected, double cosine) const {
  if (film.strength >= 1) return Rgb(1) - reflected;
  // Without a film, what the strongest colour leaves over.
  Fresnel bare = *this;
  bare.film = {};
  const Rgb plain = bare.at(cosine);
  return Rgb(1) - reflected - (Rgb(max_value(plain)) - plain) * (1 - film.strength);
}

namespace {

ThinFilm film_of(const Material& m, ShaderMode mode) {
  if (m.iridescence <= 0) return {};
  const double strength = m.iridescence * film_presence(m.iridescence_ior, m.iridescence_thickness);
  if (strength <= 0) return {};
  return {strength, m.iridescence_ior, m.iridescence_thickness, mode == ShaderMode::conserving};
}

}  // namespace

Fresnel dielectric_fresnel(const Material& m, double eta, ShaderMode mode) {
  const double f0 = m.ior == 0 ? 1 : f0_of_ior(m.ior, m.outside_ior);
  const Rgb color(std::min(f0 * m.specular_color.x, 1.0), std::min(f0 * m.specular_color.y, 1.0),
                  std::min(f0 * m.specular_color.z, 1.0));
  return {color * m.specular, Rgb(m.specular), eta, film_of(m, mode)};
}

Fresnel metal_fresnel(const Material& m, ShaderMode mode) {
  return {m.base_color, Rgb(1), 1, film_of(m, mode)};
}

Rgb dispersed_ior(double ior, double dispersion) {
  const double half_spread = (ior - 1) * 0.025 * dispersion;  // 0.5 / 20, as in the text
  return {std::max(ior - half_spread, 1.0), ior, ior + half_spread};
}

double dispersed_ior(double ior, double dispersion, double wavelength) {
  // Cauchy's equation with the lines of the text.
  const double spread = (ior - 1) * dispersion / 20;  // (n - 1) over the Abbe number
  return std::max(ior + spread * (523655 / square(wavelength) - 1.5168), 1.0);
}

}  // namespace gltfx::shader
