// SPDX-License-Identifier: Apache-2.0
#include "bake/albedo.hpp"

#include <algorithm>

#include "bake/microfacet.hpp"

namespace gltfx::bake {
namespace {

Vec3d direction(double cosine) { return {std::sqrt(std::max(0.0, 1 - square(cosine))), 0, cosine}; }

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

// Sum over the points that two cells take their values from, four at a time.
double weigh(const AlbedoRow* table, const TableCell& row, const TableCell& column) {
  std::array<float, 4> sums{};
  for (std::size_t r = 0; r < 4; ++r) {
    const float* values = table[row.first + r].data() + column.first;
    for (std::size_t c = 0; c < 4; ++c) sums[c] += row.weights[r] * values[c];
  }
  const auto& w = column.weights;
  return static_cast<double>((sums[0] * w[0] + sums[1] * w[1]) + (sums[2] * w[2] + sums[3] * w[3]));
}

}  // namespace

SpecularAlbedo integrate_specular_albedo(double roughness, double cosine, int resolution) {
  const Microfacets facets = microfacets(std::max(roughness, 0.01));
  const Vec3d v = direction(cosine);
  const double stretched = facets.stretched(v);
  const Vec3d sum = mean(resolution, [&](double u, double turn) -> Vec3d {
    const Vec3d h = facets.sample_normal(v, u, turn);
    const double v_h = dot(v, h);
    const Vec3d l = 2 * v_h * h - v;
    if (l.z <= 0) return {};
    const double weight = facets.visibility(v, stretched, l) * 2 * l.z * (v.z + stretched);
    return {weight * (1 - pow5(1 - v_h)), weight * pow5(1 - v_h), 0};
  });
  return {sum.x, sum.y};
}

double integrate_diffuse_fresnel(double cosine, int resolution) {
  const Vec3d v = direction(cosine);
  return mean(resolution, [&](double u, double turn) {
    return pow5(1 - Directions(v, cosine_hemisphere(u, turn)).v_h);
  });
}

double integrate_sheen_albedo(double sheen_roughness, double cosine, int resolution) {
  const Fibres fibres(sheen_roughness);
  const Vec3d v = direction(cosine);
  const double lambda_v = fibres.lambda(v.z);
  return mean(resolution, [&](double u, double turn) {
    const Vec3d l = uniform_hemisphere(1 - u, turn);  // more of them near the horizon
    const Directions d(v, l);
    return 2 * pi * l.z * fibres.distribution(d.h.z) * fibres.visibility(v.z, lambda_v, l.z);
  });
}

TableCell::TableCell(double x, int size) {
  const auto scaled = static_cast<float>(std::clamp(x, 0.0, 1.0)) * static_cast<float>(size - 1);
  const int cell = std::min(static_cast<int>(scaled), size - 2);
  const float t = scaled - static_cast<float>(cell);
  const float a = t * (-0.5F + t * (1 - 0.5F * t));
  const float b = 1 + t * t * (-2.5F + 1.5F * t);
  const float c = t * (0.5F + t * (2 - 1.5F * t));
  const float d = t * t * (-0.5F + 0.5F * t);
  first = static_cast<std::size_t>(std::clamp(cell - 1, 0, size - 4));
  if (cell == 0) {
    weights = {b + 2 * a, c - a, d, 0};
  } else if (cell == size - 2) {
    weights = {0, a, b - d, c + 2 * d};
  } else {
    weights = {a, b, c, d};
  }
}

TableCell albedo_column(double cosine) { return {std::sqrt(std::sqrt(cosine)), kAlbedoColumns}; }

SpecularAlbedo SpecularCurve::at(const TableCell& column) const {
  return {weigh(kSpecularConstant.data(), row_, column),
          weigh(kSpecularRising.data(), row_, column)};
}

double SheenCurve::at(double cosine) const {
  return weigh(kSheenAlbedo.data(), row_, albedo_column(cosine));
}

double diffuse_fresnel(double x) {
  // A fit to integrate_diffuse_fresnel(), off by 8e-6 at most.
  return 0.0281636625 +
         x * (-0.0798414128 + x * (0.0864126795 + x * (-0.0436042617 + x * 0.0089516657)));
}

}  // namespace gltfx::bake
