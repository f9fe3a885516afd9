// SPDX-License-Identifier: Apache-2.0
#include "shader/albedo_inside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "base/fork.hpp"
#include "base/packed.hpp"
#include "shader/albedo.hpp"
#include "shader/integration.hpp"
#include "shader/visible_facets.hpp"

namespace gltfx::shader {
namespace {

// The reflectance of the layer; reflectance(v.h) is that of a facet.
template <class Reflectance>
auto sum_layer(const Lattice& lattice, const Microfacets& facets, const Vec3d& v,
               const Reflectance& reflectance) {
  using Sum = decltype(reflectance(0.0));
  return sum_facets(lattice, facets, v, [&](const Vec3d& h, const auto& part_of) {
    const double v_h = dot(v, h);
    const Vec3d l = 2 * v_h * h - v;
    return l.z > 0 ? reflectance(v_h) * part_of(l) : Sum{};
  });
}

// The integral of max(l.z, 0) over a turn of l around v.
double cosines_around(double v_z, double cosine, double sine) {
  const double middle = cosine * v_z;
  const double swing = sine * std::sqrt(1 - std::min(square(v_z), 1.0));
  if (middle >= swing) return 2 * pi * middle;
  if (middle <= -swing) return 0;
  const double rise = std::acos(-middle / swing);
  return 2 * (middle * rise + swing * std::sin(rise));
}

// The transmittance to diffuse lobes by 1 - F, which depends on the angle between v and l alone,
// twice the angle to the facet. Over the angle of refracted light the integrand is smooth.
template <class Reflectance>
auto sum_base(double eta, double v_z, const Reflectance& reflectance) {
  static constinit MadeOnce<std::vector<Node>> nodes;
  using Sum = decltype(reflectance(0.0));
  Sum sum{};
  for (const Node& node : nodes.get([] { return gauss_legendre(10); })) {
    const double out = node.x * pi / 2;
    const double sine = eta * std::sin(out);
    const double cosine = std::sqrt(1 - square(sine));
    const double turn = cosines_around(v_z, 1 - 2 * square(sine), 2 * sine * cosine);
    const double width = pi / 2 * node.weight * 2 * eta * std::cos(out) / cosine;
    sum += (Sum(1) - reflectance(cosine)) * (turn * 2 * sine * cosine * width / pi);
  }
  return sum;
}

double share_of(double layer, double base, double margin) {
  constexpr double kMost = 4;  // in front of a base that has next to nothing of the light
  return base > 0 ? std::clamp((1 - layer - margin) / base, 0.0, kMost) : 1;
}

// What the layer takes from the base.
Rgb taken(const Fresnel& fresnel, double cosine) {
  return Rgb(1) - fresnel.left_over(fresnel.at(cosine), cosine);
}

Rgb summed_share(const Fresnel& fresnel, const Microfacets& facets, const Vec3d& v,
                 const Rgb& layer_scale) {
  const auto reflectance = [&](double cosine) { return taken(fresnel, cosine); };
  const Rgb layer =
      (facets.smooth() ? reflectance(v.z) : sum_layer({377, 233}, facets, v, reflectance)) *
      layer_scale;
  const Rgb base = sum_base(fresnel.eta, v.z, reflectance);
  const double margin = facets.smooth() ? 1e-4 : 0.007;  // for so few points
  return {share_of(layer.x, base.x, margin), share_of(layer.y, base.y, margin),
          share_of(layer.z, base.z, margin)};
}

// The sums for one ratio of indices without a film. They are linear in F0 and F90: x is the total
// reflection, y is for each F0, z for each F90. Cells are computed at first use. Rows of the layer
// are by the logarithm of alpha. Its columns are dense around the cosine at which total reflection
// begins, and around 0, closer the narrower the lobe.
class InsideTable {
 public:
  explicit InsideTable(double eta)
      : eta_(eta),
        edge_(std::sqrt(1 - square(eta))),
        layers_(std::size_t{kRows} * kColumns, kUnknown),
        bases_(kBases, kUnknown) {
    for (std::size_t i = 0; i < kRows; ++i) {
      rows_[i].alpha = std::pow(kSmoothAlpha, 1 - static_cast<double>(i) / (kRows - 1));
      rows_[i].first = place(rows_[i], 0);
      rows_[i].last = place(rows_[i], 1);
    }
  }
  double eta() const { return eta_; }

  double share(const Fresnel& fresnel, const Microfacets& facets, double cosine,
               double layer_scale) {
    const Rgb by(1, max_value(fresnel.f0), max_value(fresnel.f90));
    const TableCell row(1 - std::log(facets.alpha_b) / std::log(kSmoothAlpha), kRows);
    double layer = 0;
    for (std::size_t i = 0; i < row.weights.size(); ++i)
      layer += row.weights[i] * dot(layer_at(row.first + i, cosine), by);
    const TableCell column(cosine, kBases);
    double base = 0;
    for (std::size_t i = 0; i < column.weights.size(); ++i)
      base += column.weights[i] * dot(base_at(column.first + i), by);
    return share_of(layer * layer_scale, base, kMargin);
  }

 private:
  static constexpr std::size_t kRows = 48;
  static constexpr std::size_t kColumns = 96;
  static constexpr std::size_t kBases = 128;
  static constexpr double kEdge = 2;        // width of the edge, in alpha
  static constexpr double kMargin = 0.007;  // cells and points are within 0.006 of a fine sum
  static constexpr Float3 kUnknown{-1, 0, 0};

  struct Row {
    double alpha = 1;
    double first = 0, last = 1;  // positions of the columns at the ends
  };

  double place(const Row& row, double cosine) const {
    const double scale = 1 / (kEdge * row.alpha);
    return std::asinh(cosine * scale) + std::asinh((cosine - edge_) * scale);
  }

  // By bisection.
  double cosine_at(const Row& row, double wanted) const {
    double low = 0.002;
    double high = 1;
    for (int step = 0; step < 40; ++step) {
      const double middle = (low + high) / 2;
      (place(row, middle) < wanted ? low : high) = middle;
    }
    return (low + high) / 2;
  }

  Rgb reflectance(double cosine) const {
    const double sine_square = (1 - square(cosine)) / square(eta_);
    if (sine_square >= 1) return {1, 0, 0};
    const double w = pow5(1 - std::sqrt(1 - sine_square));
    return {0, 1 - w, w};
  }

  Rgb layer_at(std::size_t number, double cosine) {
    const Row& row = rows_[number];
    const TableCell column((place(row, cosine) - row.first) / (row.last - row.first), kColumns);
    Rgb sum;
    for (std::size_t i = 0; i < column.weights.size(); ++i)
      sum += layer_cell(number, column.first + i) * static_cast<double>(column.weights[i]);
    return sum;
  }

  Rgb layer_cell(std::size_t number, std::size_t column) {
    Float3& cell = layers_[number * kColumns + column];
    if (cell[0] < 0) {
      const Row& row = rows_[number];
      const double t = static_cast<double>(column) / (kColumns - 1);
      const double cosine = cosine_at(row, row.first + (row.last - row.first) * t);
      const Microfacets facets{row.alpha, row.alpha};
      cell = to_float3(sum_layer({610, 377}, facets, {std::sqrt(1 - square(cosine)), 0, cosine},
                                 [&](double v_h) { return reflectance(v_h); }));
    }
    return to_vec(cell);
  }

  Rgb base_at(std::size_t column) {
    Float3& cell = bases_[column];
    if (cell[0] < 0) {
      const double cosine = std::max(static_cast<double>(column), 0.25) / (kBases - 1);
      // The sum of 1 - F0 y - F90 z, part by part: sum_base() takes each from 1.
      cell = to_float3(sum_base(eta_, cosine, [&](double v_h) {
        const Rgb parts = reflectance(v_h);
        return Rgb(0, 1 + parts.y, 1 + parts.z);
      }));
    }
    return to_vec(cell);
  }

  double eta_;
  double edge_;  // the cosine at which total reflection begins
  std::array<Row, kRows> rows_;
  std::vector<Float3> layers_, bases_;
};

// A thread has few: indices of refraction belong to materials, not to texels.
InsideTable& table_of(double eta) {
  thread_local std::array<std::unique_ptr<InsideTable>, 6> tables;
  thread_local std::size_t oldest = 0;
  for (const auto& table : tables) {
    if (table && table->eta() == eta) return *table;
  }
  auto& place = tables[std::exchange(oldest, (oldest + 1) % tables.size())];
  place = std::make_unique<InsideTable>(eta);
  return *place;
}

}  // namespace

Rgb share_inside(const Fresnel& fresnel, const Microfacets& facets, const Vec3d& v,
                 const Rgb& layer_scale) {
  const bool in_table = facets.isotropic() && !facets.smooth() && fresnel.film.strength <= 0;
  return in_table ? Rgb(table_of(fresnel.eta).share(fresnel, facets, v.z, max_value(layer_scale)))
                  : summed_share(fresnel, facets, v, layer_scale);
}

double summed_albedo(const Fresnel& fresnel, const Microfacets& facets, const Vec3d& v) {
  constexpr Lattice kLattice{144, 89};
  return max_value(sum_facets(kLattice, facets, v, [&](const Vec3d& h, const auto& part_of) {
    const double v_h = dot(v, h);
    const Rgb reflected = taken(fresnel, v_h);
    const Vec3d mirror = 2 * v_h * h - v;
    const Rgb sum = mirror.z > 0 ? reflected * part_of(mirror) : Rgb();
    const double cosine_square = 1 - (1 - square(v_h)) / square(fresnel.eta);
    if (cosine_square <= 0) return sum;
    const Vec3d l = h * (v_h / fresnel.eta - std::sqrt(cosine_square)) - v / fresnel.eta;
    return l.z < 0 ? sum + (Rgb(1) - reflected) * part_of(mirrored(l)) : sum;
  }));
}

}  // namespace gltfx::shader
