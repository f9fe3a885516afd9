// SPDX-License-Identifier: Apache-2.0
/// Integrals without random numbers.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace gltfx::bake {

struct Node {
  double x, weight;
};

/// Gauss and Legendre over [0, 1]. Nodes by Newton's method.
inline std::vector<Node> gauss_legendre(int count) {
  std::vector<Node> nodes;
  for (int i = 0; i < count; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
    double slope = 1;
    for (int step = 0; step < 100; ++step) {
      double p0 = 1;
      double p1 = x;
      for (int k = 2; k <= count; ++k) {
        const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
        p0 = p1;
        p1 = p2;
      }
      slope = count * (x * p1 - p0) / (x * x - 1);
      x -= p1 / slope;
      if (std::fabs(p1 / slope) < 1e-15) break;
    }
    nodes.push_back({(1 - x) / 2, 1 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

}  // namespace gltfx::bake
