// SPDX-License-Identifier: Apache-2.0
#include "bake/albedo.hpp"

#include <algorithm>
#include <span>

#include "bake/microfacet.hpp"
#include "bake/sheen.hpp"

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

// Through b at t = 0 and c at t = 1 (Catmull and Rom).
double cubic(double a, double b, double c, double d, double t) {
  return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

// Between which of `size` points over [0, 1] a number lies, and where.
struct Cell {
  int index;
  double t;

  Cell(double x, int size) : index(std::clamp(static_cast<int>(x * (size - 1)), 0, size - 2)) {
    t = std::clamp(x, 0.0, 1.0) * (size - 1) - index;
  }

  // `at` gives the value of a point; beyond the ends the curve goes on straight.
  template <class Values>
  double interpolate(int size, const Values& at) const {
    const double b = at(index);
    const double c = at(index + 1);
    const double a = index > 0 ? at(index - 1) : 2 * b - c;
    const double d = index + 2 < size ? at(index + 2) : 2 * c - b;
    return cubic(a, b, c, d, t);
  }
};

double look_up(std::span<const AlbedoRow> table, const Cell& row, const Cell& column) {
  const int rows = static_cast<int>(table.size());
  return row.interpolate(rows, [&](int r) {
    const AlbedoRow& values = table[static_cast<std::size_t>(r)];
    return column.interpolate(kAlbedoColumns,
                              [&](int c) { return values[static_cast<std::size_t>(c)]; });
  });
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
    const Vec3d l = uniform_hemisphere(u, turn);
    if (l.z <= 0) return 0.0;
    const Directions d(v, l);
    return 2 * pi * l.z * fibres.distribution(d.h.z) * fibres.visibility(v.z, lambda_v, l.z);
  });
}

SpecularAlbedo specular_albedo(double roughness, double cosine) {
  const Cell row(roughness, kSpecularRows);
  const Cell column(std::cbrt(cosine), kAlbedoColumns);
  return {look_up(kSpecularConstant, row, column), look_up(kSpecularRising, row, column)};
}

double sheen_albedo(double sheen_roughness, double cosine) {
  return look_up(kSheenAlbedo, Cell(sheen_roughness, kSheenRows),
                 Cell(std::cbrt(cosine), kAlbedoColumns));
}

double diffuse_fresnel(double x) {
  // A fit to integrate_diffuse_fresnel(), off by 8e-6 at most.
  return 0.0281636625 +
         x * (-0.0798414128 + x * (0.0864126795 + x * (-0.0436042617 + x * 0.0089516657)));
}

}  // namespace gltfx::bake
