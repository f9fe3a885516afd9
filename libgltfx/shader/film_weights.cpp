// SPDX-License-Identifier: Apache-2.0
#include "shader/film_weights.hpp"

#include <algorithm>
#include <utility>

#include "base/fork.hpp"
#include "base/lanes.hpp"
#include "base/remembered.hpp"
#include "shader/visible_facets.hpp"

namespace gltfx::shader {
namespace {

constexpr std::array<FilmWeightRows, kFilmRows> kFilmWeights{{
#include "shader/tables/film_weights.inc"
}};
static_assert(kFilmColumns % kLanes == 0);

void add(FilmWeightRows& sums, const FilmWeightRows& rows, float weight) {
  for (std::size_t i = 0; i < kFilmColumns; ++i) {
    for (std::size_t k = 0; k < kFilmColumns; k += kLanes) {
      float* const at = sums[i].data() + k;
      store_lanes(load_lanes(at) + weight * load_lanes(rows[i].data() + k), at);
    }
  }
}

// A direction under which the roughness is `azimuth` of the way from across to along, from the
// direction of anisotropy.
Vec3d view_under(const Microfacets& facets, double azimuth, double cosine) {
  const double least = std::sqrt(facets.alpha_b);
  const double alpha = square(least + azimuth * (std::sqrt(facets.alpha_t) - least));
  const double range = square(facets.alpha_t) - square(facets.alpha_b);
  const double along =
      range > 0 ? std::clamp((square(alpha) - square(facets.alpha_b)) / range, 0.0, 1.0) : azimuth;
  const double sine = std::sqrt(1 - square(cosine));
  return {sine * std::sqrt(along), sine * std::sqrt(1 - along), cosine};
}

AnisotropicFilmWeights sum_weights(const Microfacets& facets) {
  constexpr Lattice kLattice{233, 144};
  AnisotropicFilmWeights weights{};
  for (std::size_t a = 0; a < kAzimuthRows; ++a) {
    for (std::size_t i = 0; i < kFilmColumns; ++i) {
      const double cosine = std::max(film_cosine(static_cast<int>(i)), 1e-7);
      const Vec3d v = view_under(facets, azimuth_part(static_cast<int>(a)), cosine);
      for_each_facet(kLattice, facets, v, [&](const Vec3d& h, const auto& part_of) {
        const double v_h = dot(v, h);
        const Vec3d l = 2 * v_h * h - v;
        if (l.z <= 0) return;
        const auto part = static_cast<float>(part_of(l) / kLattice.points);
        const TableCell cell = film_column(v_h);
        for (std::size_t k = 0; k < cell.weights.size(); ++k)
          weights[a][i][cell.first + k] += part * cell.weights[k];
      });
    }
  }
  return weights;
}

// Of a lobe of the tables of anisotropic lobes.
const AnisotropicFilmWeights& weights_at(std::size_t along, std::size_t across) {
  static constinit std::array<std::array<MadeOnce<AnisotropicFilmWeights>, kAcrossRows>, kAlongRows>
      known;
  return known[along][across].get([&] {
    const double wide = square(along_roughness(static_cast<int>(along)));
    const double narrow = wide * square(across_ratio(static_cast<int>(across)));
    return sum_weights({std::max(wide, kSmoothAlpha), std::max(narrow, kSmoothAlpha)});
  });
}

}  // namespace

FilmWeightRows film_weights(double roughness) {
  const TableCell cell(roughness, kFilmRows);
  FilmWeightRows sums{};
  for (std::size_t r = 0; r < cell.weights.size(); ++r)
    add(sums, kFilmWeights[cell.first + r], cell.weights[r]);
  return sums;
}

std::shared_ptr<const AnisotropicFilmWeights> anisotropic_film_weights(const Microfacets& facets) {
  thread_local Remembered<std::pair<double, double>, AnisotropicFilmWeights, 2> known;
  return known.get({facets.alpha_t, facets.alpha_b}, [&facets] {
    AnisotropicFilmWeights sums{};
    AnisotropicCell(facets).visit([&](std::size_t along, std::size_t across, float weight) {
      const AnisotropicFilmWeights& rows = weights_at(along, across);
      for (std::size_t a = 0; a < kAzimuthRows; ++a) add(sums[a], rows[a], weight);
    });
    return sums;
  });
}

}  // namespace gltfx::shader
