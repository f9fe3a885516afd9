// SPDX-License-Identifier: Apache-2.0
/// Energy conservation of a dielectric's layer with a thin film.
///
/// The reflectance of a film is no curve of Schlick: it rises and falls with the angle. The light
/// that the layer leaves over is a sum over the reflectances at some angles, by a table of how
/// often facets of a roughness are seen under each. The base gets r(V) r(L) / m of it: r is what is
/// left over, m its mean, colour by colour. (C. Kulla and A. Conty, Revisiting Physically Based
/// Shading at Imageworks, 2017.) An anisotropic lobe has about the table of the isotropic one that
/// reflects the same share of its light under grazing angles.
#pragma once

#include <array>

#include "shader/albedo.hpp"
#include "shader/fresnel.hpp"
#include "shader/multiple_scattering.hpp"

namespace gltfx::shader {

/// Cosines at which a film is evaluated: squares of even numbers from 0 to 1.
inline constexpr int kFilmColumns = 24;
/// Rows of the table, by roughness from 0 to 1.
inline constexpr int kFilmRows = 12;

inline TableCell film_column(double cosine) { return {std::sqrt(cosine), kFilmColumns}; }
constexpr double film_cosine(int column) {
  const double root = column / (kFilmColumns - 1.0);
  return root * root;
}

/// What a film of full strength on facets leaves over for diffuse lobes below.
class FilmLayer {
 public:
  /// Precondition: `fresnel` has a film and is not seen from the dense side. `anisotropic`: of the
  /// facets, or null where they are not; it must outlive this. `bounced`: the part of the light
  /// that facets block which the layer reflects.
  FilmLayer(const Fresnel& fresnel, const Microfacets& facets, const AnisotropicAlbedo* anisotropic,
            const Vec3d& v, const Rgb& bounced);

  /// The part of diffuse light that passes, reciprocal; `fresnel`: as before.
  Rgb passed(const Fresnel& fresnel, const Vec3d& l) const {
    return scale_ * left_over(fresnel, l);
  }

 private:
  using Colors = std::array<std::array<float, kFilmColumns>, 3>;
  Rgb left_over(const Fresnel& fresnel, const Vec3d& direction) const;

  bool smooth_;
  const AnisotropicAlbedo* anisotropic_;
  /// By azimuth_of(), colour and cosine, unless it is smooth; one for all azimuths of an isotropic
  /// layer.
  std::array<Colors, kAzimuthRows> left_over_{};
  Rgb scale_;  ///< what is left over towards the viewer, over the mean
};

}  // namespace gltfx::shader
