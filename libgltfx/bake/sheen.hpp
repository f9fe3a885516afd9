// SPDX-License-Identifier: Apache-2.0
/// The fibres of KHR_materials_sheen: the "Charlie" distribution and its visibility (A. Conty and
/// C. Kulla, Production Friendly Microfacet Sheen BRDF, 2017).
#pragma once

#include "bake/directions.hpp"

namespace gltfx::bake {

struct Fibres {
  double alpha;

  /// The distribution is not defined at roughness 0; so smooth a sheen reflects no light.
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

}  // namespace gltfx::bake
