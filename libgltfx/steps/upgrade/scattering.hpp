// SPDX-License-Identifier: Apache-2.0
/// Arithmetic for media that scatter light. For channels R, G, B; lengths in metres, coefficients
/// in 1/m.
#pragma once

#include <array>

namespace gltfx::upgrade {

using Rgb = std::array<double, 3>;

/// Coefficient of a medium that reduces white light to `color` over `distance`: -ln(color) /
/// distance. A channel with 0 counts as 1e-6.
Rgb coefficient(const Rgb& color, double distance);

/// Multi-scatter albedo, clamped to 0 .. 1, of a single-scatter albedo and isotropic scattering
/// (Kulla and Conty 2017, as in KHR_materials_volume_scatter, inverted). The result for 1 is 1.
double multi_scatter_albedo(double single_scatter);

/// A medium, with the members of KHR_materials_volume and its scattering extension.
struct Medium {
  Rgb attenuation_color;        ///< colour after attenuation_distance; absorption and scattering
  double attenuation_distance;  ///< mean free path: 1 / the mean of the three coefficients
  Rgb multi_scatter_color;
};

/// The medium that scatters and absorbs with these coefficients, which are not all 0.
Medium medium_of(const Rgb& scattering, const Rgb& absorption);

}  // namespace gltfx::upgrade
