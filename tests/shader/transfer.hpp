// SPDX-License-Identifier: Apache-2.0
/// Light that a half space of an evenly scattering medium gives back, by S. Chandrasekhar,
/// Radiative Transfer (1950).
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace gltfx::shader {

/// What comes back under the cosine `mu` of light of radiance 1 from everywhere:
/// 1 - sqrt(1 - w) H(mu). `w`: single scattering albedo below 1. The H function is solved by
/// iteration, to some 1e-3.
inline double plane_albedo(double w, double mu) {
  constexpr int kNodes = 200;
  std::vector<double> h(kNodes, 1.0);
  const auto node = [](int i) { return (i + 0.5) / kNodes; };
  const auto inverse = [&](double x) {
    double sum = 0;
    for (int i = 0; i < kNodes; ++i) {
      sum += node(i) * h[static_cast<std::size_t>(i)] / (x + node(i)) / kNodes;
    }
    return std::sqrt(1 - w) + w / 2 * sum;
  };
  for (int step = 0; step < 60; ++step) {
    std::vector<double> next;
    for (int i = 0; i < kNodes; ++i) next.push_back(1 / inverse(node(i)));
    h = next;
  }
  return 1 - std::sqrt(1 - w) / inverse(mu);
}

}  // namespace gltfx::shader
