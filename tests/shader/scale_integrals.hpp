// SPDX-License-Identifier: Apache-2.0
/// The scales of lobes that lose nothing: what the tables of shader/multiple_scattering.hpp hold.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "albedo_integrals.hpp"
#include "shader/multiple_scattering.hpp"

namespace gltfx::shader {

/// Places of a table, and their weights, from which a value is interpolated.
struct Interpolation {
  std::array<std::size_t, 16> places{};
  std::array<double, 16> weights{};
};

/// Finds s with s(v) times the integral of lobe(v, l) s(l) = 1 for all v of a table.
/// `interpolation(l)` reads it; `views` has a direction for each place. Also gives the albedos of
/// the lobe itself.
struct Balanced {
  std::vector<double> scale, albedo;
};

template <class Read>
Balanced balance(const Microfacets& facets, const std::vector<Vec3d>& views, int resolution,
                 const Read& interpolation) {
  struct Light {
    Interpolation from;
    double part;
  };
  std::vector<std::vector<Light>> lights(views.size());
  const auto place = [&](double i) { return 1 - square(1 - i / resolution); };
  for (std::size_t n = 0; n < views.size(); ++n) {
    const Vec3d& v = views[n];
    const double stretched = facets.stretched(v);
    for (int i = 0; i < resolution; ++i) {
      const double width = (place(i + 1) - place(i)) / resolution;
      for (int j = 0; j < resolution; ++j) {
        const Vec3d h = facets.sample_normal(v, place(i + 0.5), (j + 0.5) / resolution);
        const Vec3d l = 2 * dot(v, h) * h - v;
        if (l.z <= 0) continue;
        const double part = facets.visibility(v, stretched, l) * 2 * l.z * (v.z + stretched);
        lights[n].push_back({interpolation(l), part * width});
      }
    }
  }
  Balanced result{std::vector<double>(views.size(), 1), {}};
  constexpr int kSteps = 16;  // each halves the error at least
  for (int step = 0; step < kSteps; ++step) {
    std::vector<double> next(views.size());
    for (std::size_t n = 0; n < views.size(); ++n) {
      double sum = 0;
      for (const Light& light : lights[n]) {
        double scale = 0;
        for (std::size_t k = 0; k < light.from.places.size(); ++k)
          scale += light.from.weights[k] * result.scale[light.from.places[k]];
        sum += light.part * scale;
      }
      if (step == 0) result.albedo.push_back(sum);
      next[n] = std::sqrt(result.scale[n] / sum);
    }
    result.scale = next;
  }
  return result;
}

/// By column of the table of isotropic lobes.
inline Balanced balance_isotropic(double roughness, int resolution) {
  std::vector<Vec3d> views;
  for (int c = 0; c < kAlbedoColumns; ++c) views.push_back(direction(column_cosine(c)));
  return balance(microfacets(std::max(roughness, 0.01)), views, resolution, [](const Vec3d& l) {
    const TableCell cell = albedo_column(std::min(l.z, 1.0));
    Interpolation from;
    for (std::size_t i = 0; i < cell.weights.size(); ++i) {
      from.places[i] = cell.first + i;
      from.weights[i] = static_cast<double>(cell.weights[i]);
    }
    return from;
  });
}

/// A direction under which the roughness is `azimuth` of the way from across to along.
inline Vec3d direction_of_azimuth(const Microfacets& facets, double azimuth, double cosine) {
  const double least = std::sqrt(facets.alpha_b);
  const double roughness = least + azimuth * (std::sqrt(facets.alpha_t) - least);
  const double range = square(facets.alpha_t) - square(facets.alpha_b);
  const double along =
      range > 0 ? std::clamp((square(square(roughness)) - square(facets.alpha_b)) / range, 0.0, 1.0)
                : azimuth;
  const double sine = std::sqrt(std::max(0.0, 1 - square(cosine)));
  return {sine * std::sqrt(along), sine * std::sqrt(1 - along), cosine};
}

inline double scale_cosine(int column) {
  const double root = column == 0 ? 0.02 : column / (kScaleColumns - 1.0);
  return square(square(root));
}

/// By azimuth and column of the table of anisotropic lobes.
inline Balanced balance_anisotropic(const Microfacets& facets, int resolution) {
  std::vector<Vec3d> views;
  for (int a = 0; a < kAzimuthRows; ++a) {
    for (int c = 0; c < kScaleColumns; ++c)
      views.push_back(direction_of_azimuth(facets, azimuth_part(a), scale_cosine(c)));
  }
  return balance(facets, views, resolution, [&](const Vec3d& l) {
    const TableCell azimuth = azimuth_row(azimuth_of(facets, l));
    const TableCell cell = scale_column(std::min(l.z, 1.0));
    Interpolation from;
    for (std::size_t a = 0; a < azimuth.weights.size(); ++a) {
      for (std::size_t i = 0; i < cell.weights.size(); ++i) {
        const std::size_t at = a * cell.weights.size() + i;
        from.places[at] = (azimuth.first + a) * kScaleColumns + cell.first + i;
        from.weights[at] = static_cast<double>(azimuth.weights[a] * cell.weights[i]);
      }
    }
    return from;
  });
}

/// The albedo of an anisotropic lobe under Schlick's Fresnel.
inline SpecularAlbedo integrate_anisotropic_albedo(const Microfacets& facets, const Vec3d& v,
                                                   int resolution) {
  const double stretched = facets.stretched(v);
  const auto place = [&](double i) { return 1 - square(1 - i / resolution); };
  SpecularAlbedo sum;
  for (int i = 0; i < resolution; ++i) {
    const double width = (place(i + 1) - place(i)) / resolution;
    for (int j = 0; j < resolution; ++j) {
      const Vec3d h = facets.sample_normal(v, place(i + 0.5), (j + 0.5) / resolution);
      const double v_h = dot(v, h);
      const Vec3d l = 2 * v_h * h - v;
      if (l.z <= 0) continue;
      const double part = width * facets.visibility(v, stretched, l) * 2 * l.z * (v.z + stretched);
      sum.constant += part * (1 - pow5(1 - v_h));
      sum.rising += part * pow5(1 - v_h);
    }
  }
  return sum;
}

/// The mean of a function of the cosine over a hemisphere.
template <class Function>
double mean_over_cosines(const Function& f) {
  constexpr int kPoints = 400;
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) sum += f(std::sqrt((i + 0.5) / kPoints)) / kPoints;
  return sum;
}

/// The albedo of a refracting interface by parts: of facets that reflect nothing but totally, and
/// what F0 and F90 add. `eta` as in Fresnel.
inline Vec3d integrate_glass_albedo(double eta, double roughness, double cosine, int resolution) {
  const Microfacets facets = microfacets(std::max(roughness, 0.01));
  const Vec3d v = direction(cosine);
  const double stretched = facets.stretched(v);
  const auto part_of = [&](const Vec3d& l) {
    return facets.visibility(v, stretched, l) * 2 * l.z * (v.z + stretched);
  };
  return mean(resolution, [&](double u, double turn) -> Vec3d {
    const Vec3d h = facets.sample_normal(v, u, turn);
    const double v_h = dot(v, h);
    const Vec3d mirror = 2 * v_h * h - v;
    const double reflected = mirror.z > 0 ? part_of(mirror) : 0;
    const double cosine_square = 1 - (1 - square(v_h)) / square(eta);
    if (cosine_square <= 0) return {reflected, 0, 0};
    const double beyond = std::sqrt(cosine_square);
    const Vec3d l = h * (v_h / eta - beyond) - v / eta;
    const double transmitted = l.z < 0 ? part_of(mirrored(l)) : 0;
    const double w = pow5(1 - (eta < 1 ? beyond : v_h));
    return {transmitted, (1 - w) * (reflected - transmitted), w * (reflected - transmitted)};
  });
}

}  // namespace gltfx::shader
