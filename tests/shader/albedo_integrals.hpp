// SPDX-License-Identifier: Apache-2.0
/// Directional albedos by quadrature, with `resolution` squared points: what the tables of
/// shader/albedo.hpp hold.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "shader/albedo.hpp"
#include "shader/film_layer.hpp"
#include "shader/microfacet.hpp"

namespace gltfx::shader {

inline Vec3d direction(double cosine) {
  return {std::sqrt(std::max(0.0, 1 - square(cosine))), 0, cosine};
}

// Mean of f(u, v) over the unit square, by midpoints; v is an angle over half a turn, as all is
// symmetric to the plane of the view. Points crowd towards u = 1, where lobes run out slowly.
template <class Function>
auto mean(int resolution, const Function& f) {
  decltype(f(0.0, 0.0)) sum{};
  const auto place = [&](double i) { return 1 - square(1 - i / resolution); };
  for (int i = 0; i < resolution; ++i) {
    const double u = place(i + 0.5);
    const double width = place(i + 1) - place(i);
    for (int j = 0; j < resolution; ++j) sum += f(u, 0.5 * (j + 0.5) / resolution) * width;
  }
  return sum * (1.0 / resolution);
}

// Light of the specular lobe by its facets: value(v_h, l) of each, times its part of all light.
template <class Function>
auto mean_of_facets(const Microfacets& facets, const Vec3d& v, int resolution,
                    const Function& value) {
  const double stretched = facets.stretched(v);
  return mean(resolution, [&](double u, double turn) {
    const Vec3d h = facets.sample_normal(v, u, turn);
    const double v_h = dot(v, h);
    const Vec3d l = 2 * v_h * h - v;
    if (l.z <= 0) return decltype(value(v_h, l)){};
    return value(v_h, l) * (facets.visibility(v, stretched, l) * 2 * l.z * (v.z + stretched));
  });
}

inline SpecularAlbedo integrate_specular_albedo(double roughness, double cosine, int resolution) {
  const Microfacets facets = microfacets(std::max(roughness, 0.01));
  const Vec3d sum = mean_of_facets(
      facets, direction(cosine), resolution,
      [](double v_h, const Vec3d&) { return Vec3d(1 - pow5(1 - v_h), pow5(1 - v_h), 0); });
  return {sum.x, sum.y};
}

/// A number for each cosine at which a film is evaluated.
struct FilmWeights {
  std::array<double, kFilmColumns> at{};

  FilmWeights operator*(double scale) const {
    FilmWeights scaled = *this;
    for (double& each : scaled.at) each *= scale;
    return scaled;
  }
  FilmWeights& operator+=(const FilmWeights& other) {
    for (std::size_t i = 0; i < at.size(); ++i) at[i] += other.at[i];
    return *this;
  }
};

/// What the table of shader/film_layer.hpp holds for a roughness and a cosine of the view.
inline FilmWeights integrate_film_weights(double roughness, double cosine, int resolution) {
  const Microfacets facets = microfacets(std::max(roughness, 0.01));
  return mean_of_facets(facets, direction(std::max(cosine, 1e-7)), resolution,
                        [](double v_h, const Vec3d&) {
                          FilmWeights weights;
                          const TableCell cell = film_column(v_h);
                          for (std::size_t i = 0; i < cell.weights.size(); ++i)
                            weights.at[cell.first + i] += static_cast<double>(cell.weights[i]);
                          return weights;
                        });
}

inline double integrate_diffuse_fresnel(double cosine, int resolution) {
  const Vec3d v = direction(cosine);
  return mean(resolution, [&](double u, double turn) {
    return pow5(1 - Directions(v, cosine_hemisphere(u, turn)).v_h);
  });
}

inline double integrate_sheen_albedo(double sheen_roughness, double cosine, int resolution) {
  const Fibres fibres(sheen_roughness);
  const Vec3d v = direction(cosine);
  const double lambda_v = fibres.lambda(v.z);
  return mean(resolution, [&](double u, double turn) {
    const Vec3d l = uniform_hemisphere(1 - u, turn);  // more of them near the horizon
    const Directions d(v, l);
    return 2 * pi * l.z * fibres.distribution(d.h.z) * fibres.visibility(v.z, lambda_v, l.z);
  });
}

}  // namespace gltfx::shader
