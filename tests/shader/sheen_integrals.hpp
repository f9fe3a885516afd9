// SPDX-License-Identifier: Apache-2.0
/// What the tables of shader/sheen_scaling.hpp hold.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "albedo_integrals.hpp"
#include "shader/multiple_scattering.hpp"
#include "shader/sheen_scaling.hpp"

namespace gltfx::shader {

/// A light of a view: its part of the albedo, and where the values of its cosine are in a table.
struct CosineLight {
  double part;
  double cosine;
  TableCell cell;
};

template <class Column>
double value_of(const Column& column, const TableCell& cell) {
  double sum = 0;
  for (std::size_t i = 0; i < cell.weights.size(); ++i)
    sum += static_cast<double>(cell.weights[i]) * column[cell.first + i];
  return sum;
}

/// Of a row of the sheen, by column: c and the albedo.
struct HeldSheenRow {
  std::array<double, kAlbedoColumns> scale{}, albedo{};
};

inline HeldSheenRow balance_sheen(double roughness, int resolution) {
  const Fibres fibres(roughness);
  std::array<std::vector<CosineLight>, kAlbedoColumns> lights;
  HeldSheenRow row;
  for (int c = 0; c < kAlbedoColumns; ++c) {
    const auto at = static_cast<std::size_t>(c);
    const Vec3d v = direction(column_cosine(c));
    const double lambda_v = fibres.lambda(v.z);
    mean(resolution, [&](double u, double turn) {
      const Vec3d l = uniform_hemisphere(1 - u, turn);
      const Directions d(v, l);
      const double value = 2 * pi * l.z * fibres.distribution(d.h.z) *
                           fibres.visibility(v.z, lambda_v, l.z) * 2 * std::sqrt(1 - u) /
                           square(resolution);
      if (value > 1e-12) lights[at].push_back({value, l.z, albedo_column(l.z)});
      return 0.0;
    });
    for (const CosineLight& light : lights[at]) row.albedo[at] += light.part;
    row.albedo[at] = std::min(row.albedo[at], 1.0);
  }
  row.scale.fill(1);
  constexpr int kSteps = 40;
  for (int step = 0; step < kSteps; ++step) {
    std::array<double, kAlbedoColumns> next{};
    for (std::size_t c = 0; c < lights.size(); ++c) {
      double sum = 0;
      for (const CosineLight& light : lights[c])
        sum += light.part * value_of(row.scale, light.cell);
      next[c] = sum > 1e-6 ? std::sqrt(row.scale[c] * row.albedo[c] / sum) : 1;
    }
    row.scale = next;
  }
  return row;
}

inline double below_cosine(int column) {
  const double root = column == 0 ? 0.02 : column / (kBelowColumns - 1.0);
  return square(square(root));
}

/// Light that gloss sends to each view of a table, of which nothing is lost.
using GlossLights = std::array<std::vector<CosineLight>, kBelowColumns>;

inline GlossLights gloss_lights(double roughness, int resolution) {
  const Microfacets facets = microfacets(std::max(roughness, 0.01));
  GlossLights lights;
  for (int c = 0; c < kBelowColumns; ++c) {
    const Vec3d v = direction(below_cosine(c));
    const MultipleScattering bounces(facets, v);
    std::vector<CosineLight>& all = lights[static_cast<std::size_t>(c)];
    const double stretched = facets.stretched(v);
    const auto place = [&](double i) { return 1 - square(1 - i / resolution); };
    double sum = 0;
    for (int i = 0; i < resolution; ++i) {
      for (int j = 0; j < resolution; ++j) {
        const Vec3d h = facets.sample_normal(v, place(i + 0.5), 0.5 * (j + 0.5) / resolution);
        const Vec3d l = 2 * dot(v, h) * h - v;
        if (l.z <= 0) continue;
        const double part = facets.visibility(v, stretched, l) * 2 * l.z * (v.z + stretched) *
                            bounces.scale(l) * (place(i + 1) - place(i));
        all.push_back({part, l.z, below_column(std::min(l.z, 1.0))});
        sum += part;
      }
    }
    for (CosineLight& light : all) light.part /= sum;
  }
  return lights;
}

/// m of gloss below a sheen: with g = a / sqrt(m), g(V) times the mean of g over lights is a(V).
inline std::array<double, kBelowColumns> balance_below(const GlossLights& lights,
                                                       const HeldSheen& sheen, double strength) {
  std::array<std::vector<double>, kBelowColumns> left;
  for (std::size_t c = 0; c < lights.size(); ++c) {
    for (const CosineLight& light : lights[c])
      left[c].push_back(light.part * (1 - strength * sheen.albedo(light.cosine)));
  }
  std::array<double, kBelowColumns> m{};
  m.fill(1);
  constexpr int kSteps = 16;  // each halves the error at least
  for (int step = 0; step < kSteps; ++step) {
    std::array<double, kBelowColumns> next{};
    for (std::size_t c = 0; c < lights.size(); ++c) {
      double sum = 0;
      for (std::size_t i = 0; i < lights[c].size(); ++i)
        sum += left[c][i] / std::sqrt(std::clamp(value_of(m, lights[c][i].cell), 1e-4, 1.0));
      next[c] = std::sqrt(m[c]) * sum;
    }
    m = next;
  }
  return m;
}

}  // namespace gltfx::shader
