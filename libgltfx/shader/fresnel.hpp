// SPDX-License-Identifier: Apache-2.0
/// Fresnel terms: Schlick's approximation (Appendix B) with the colours of KHR_materials_specular,
/// internal reflection (KHR_materials_volume) and thin films (KHR_materials_iridescence).
#pragma once

#include <gltfx/material.hpp>

#include "shader/directions.hpp"

namespace gltfx::shader {

/// ((n - m) / (n + m))^2
constexpr double f0_of_ior(double ior, double outside_ior) {
  return square((ior - outside_ior) / (ior + outside_ior));
}

inline Rgb schlick(const Rgb& f0, const Rgb& f90, double cosine) {
  return f0 + (f90 - f0) * pow5(1 - cosine);
}
inline double schlick(double f0, double cosine) { return f0 + (1 - f0) * pow5(1 - cosine); }

/// A thin film on the surface, with an IOR of 1 outside of it.
struct ThinFilm {
  double strength = 0;  ///< `iridescence` times film_presence(); 0: no film
  double ior = 1.3;
  double thickness = 0;  ///< nanometres
  /// The fit can give slightly more than 1, which this mode clamps; and the base gets of each
  /// colour what the film leaves over.
  bool conserving = false;
};

/// From 0 for a film that is none, of thickness 0 or as thin as air, to 1.
double film_presence(double ior, double thickness);

/// iridescent_fresnel: reflectance of a film on a base with `base_f0`, prepared under a cosine.
Rgb iridescent_fresnel(double outside_ior, double film_ior, const Rgb& base_f0, double thickness,
                       double cosine);

/// The reflectance of a metal's or of a dielectric's surface.
struct Fresnel {
  Rgb f0;
  Rgb f90{1, 1, 1};
  /// IOR behind the surface over that on the viewer's side; 1 for thin-walled surfaces. Below 1
  /// there is total reflection.
  double eta = 1;
  ThinFilm film;

  Rgb at(double cosine) const {
    return eta < 1 || film.strength > 0 ? inside_or_iridescent(cosine) : schlick(f0, f90, cosine);
  }
  /// With a film of full strength.
  Rgb iridescent(double cosine) const;
  /// What a base below gets, where the surface reflects at(cosine).
  Rgb left_over(const Rgb& reflected, double cosine) const {
    return film.conserving ? left_by_film(reflected, cosine) : Rgb(1 - max_value(reflected));
  }

 private:
  Rgb inside_or_iridescent(double cosine) const;
  Rgb left_by_film(const Rgb& reflected, double cosine) const;
};

/// The surface of a dielectric: F0 by ior, scaled by specular colour and factor.
Fresnel dielectric_fresnel(const Material& material, double eta, ShaderMode mode);
/// The surface of a metal.
Fresnel metal_fresnel(const Material& material, ShaderMode mode);

/// KHR_materials_dispersion: indices of refraction of red, green and blue.
Rgb dispersed_ior(double ior, double dispersion);
/// The same for a wavelength in nanometres.
double dispersed_ior(double ior, double dispersion, double wavelength);

}  // namespace gltfx::shader
