// SPDX-License-Identifier: Apache-2.0
/// Energy conservation of a dielectric's layer with a thin film.
///
/// The reflectance of a film is no curve of Schlick: it rises and falls with the angle. The light
/// that the layer leaves over is a sum over the reflectances at some angles, by a table of how
/// often facets of a roughness are seen under each. The base gets r(V) r(L) / m of it: r is what is
/// left over, m its mean, colour by colour. (C. Kulla and A. Conty, Revisiting Physically Based
/// Shading at Imageworks, 2017.)
#pragma once

#include <array>
#include <memory>

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

/// A value for each of these cosines.
using FilmCurve = std::array<float, kFilmColumns>;

/// What a film of full strength on facets leaves over for diffuse lobes below.
class FilmLayer {
 public:
  /// Precondition: `fresnel` has a film and is not seen from the dense side. `anisotropic`: of the
  /// facets, or null where they are not. `bounced`: the part of the light that facets block which
  /// the layer reflects.
  FilmLayer(const Fresnel& fresnel, const Microfacets& facets, const AnisotropicAlbedo* anisotropic,
            const Vec3d& v, const Rgb& bounced);

  /// The part of diffuse light that passes, reciprocal; `fresnel`: as before.
  Rgb passed(const Fresnel& fresnel, const Vec3d& l) const {
    return scale_ * left_over(fresnel, l);
  }

 private:
  /// By azimuth_of(), colour and cosine; one for all azimuths of an isotropic layer.
  struct LeftOver {
    std::array<std::array<FilmCurve, 3>, kAzimuthRows> at{};
    Rgb mean;
  };
  static LeftOver make(const Fresnel& fresnel, const Microfacets& facets,
                       const AnisotropicAlbedo* anisotropic, const Rgb& bounced);
  Rgb left_over(const Fresnel& fresnel, const Vec3d& direction) const;

  Microfacets facets_;
  std::shared_ptr<const LeftOver> left_over_;
  Rgb scale_;  ///< what is left over towards the viewer, over the mean
};

}  // namespace gltfx::shader
