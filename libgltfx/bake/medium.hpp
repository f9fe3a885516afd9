// SPDX-License-Identifier: Apache-2.0
/// Homogeneous media: KHR_materials_volume, KHR_materials_sss, KHR_materials_subsurface,
/// KHR_materials_volume_scatter, KHR_materials_scatter. Coefficients are per metre.
#pragma once

#include <gltfx/material.hpp>

namespace gltfx::bake {

struct Medium {
  Rgb absorption, scattering;
  double anisotropy = 0;  ///< g of the phase function

  Rgb extinction() const { return absorption + scattering; }
  bool scatters() const { return max_value(scattering) > 0; }
  /// The part of light that `distance` metres, which may be infinite, neither absorb nor scatter.
  Rgb transmittance(double distance) const;
};

/// The medium behind the surface of a volumetric material.
Medium medium_of(const Material& material);

/// -log(c) / d: absorption and extinction by attenuation, scattering by scatter colour. 0 when the
/// distance is infinite.
Rgb coefficient(const Rgb& color, double distance);

/// The albedo of one scattering event for that of very many, by C. Kulla and A. Conty (Revisiting
/// Physically Based Shading at Imageworks, 2017); with the anisotropy g as KHR_materials_scatter
/// has it (0: as KHR_materials_volume_scatter and KHR_materials_sss).
double single_scatter_albedo(double multi_scatter_albedo, double g = 0);

/// The phase function of L. Henyey and J. Greenstein (1941), per steradian. Both directions point
/// away from the scattering point: v.l is -1 straight on.
double henyey_greenstein(double g, double v_dot_l);

/// The next direction of a path that came along `along` (-v). Its density is the phase function.
Vec3d sample_phase(const Medium& medium, const Vec3d& along, double u, double v);

}  // namespace gltfx::bake
