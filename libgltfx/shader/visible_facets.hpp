// SPDX-License-Identifier: Apache-2.0
/// Sums over the facets that a viewer sees.
#pragma once

#include "shader/microfacet.hpp"

namespace gltfx::shader {

/// Points of a square, by adjacent Fibonacci numbers: they are not aligned with edges.
struct Lattice {
  int points, turn;
};

/// Calls visit(h, part_of) for each point, whose normal is h; part_of(l) is the part of light of
/// facets that send it to l which others do not block.
template <class Visit>
void for_each_facet(const Lattice& lattice, const Microfacets& facets, const Vec3d& v,
                    const Visit& visit) {
  const auto& [points, turn] = lattice;
  const double stretched = facets.stretched(v);
  const auto part_of = [&facets, &v, stretched](const Vec3d& l) {
    return facets.visibility(v, stretched, l) * 2 * l.z * (v.z + stretched);
  };
  for (int i = 0; i < points; ++i) {
    const double second = (i * turn % points + 0.5) / points;
    visit(facets.sample_normal(v, (i + 0.5) / points, second), part_of);
  }
}

/// The mean of light(h, part_of).
template <class Light>
auto sum_facets(const Lattice& lattice, const Microfacets& facets, const Vec3d& v,
                const Light& light) {
  const auto nothing = [](const Vec3d&) { return 0.0; };
  decltype(light(Vec3d(), nothing)) sum{};
  for_each_facet(lattice, facets, v, [&](const Vec3d& h, const auto& part_of) {
    sum += light(h, part_of) * (1.0 / lattice.points);
  });
  return sum;
}

}  // namespace gltfx::shader
