// SPDX-License-Identifier: Apache-2.0
/// Radiative transfer in media that scatter light evenly, solved without random numbers: the
/// expected results of the renderer's random walks. Index-matched boundaries; lengths in mean free
/// paths; `albedo` is that of single scattering.
#pragma once

#include <vector>

namespace gltfx::ground_truth {

/// Chandrasekhar's H function (Radiative Transfer, 1950, chapter V).
class SemiInfinite {
 public:
  explicit SemiInfinite(double albedo);

  double h(double cosine) const;
  /// What comes back under a cosine from light that is even over the hemisphere.
  double plane_albedo(double cosine) const;
  /// The same for light that leaves under all angles.
  double diffuse_albedo() const;
  /// Radiance under `cosine` for a beam under `cosine0` with irradiance 1 across it.
  double radiance(double cosine0, double cosine) const;

 private:
  double albedo_;
  std::vector<double> values_;  // at the nodes of the quadrature
};

struct SlabAlbedo {
  double reflected = 0, transmitted = 0;  ///< the latter includes unscattered light
};
/// A slab of some thickness under even light from one side, seen under a cosine.
SlabAlbedo slab_albedo(double albedo, double thickness, double cosine);

struct SphereRadiance {
  double centre = 0, mean = 0;  ///< along the diameter, and over the disk that is seen
};
/// A sphere of some radius in even light of radiance 1.
SphereRadiance sphere_radiance(double albedo, double radius);

}  // namespace gltfx::ground_truth
