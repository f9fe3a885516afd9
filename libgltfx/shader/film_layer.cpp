// SPDX-License-Identifier: Apache-2.0
#include "shader/film_layer.hpp"

#include <algorithm>
#include <tuple>

#include "base/fork.hpp"
#include "base/lanes.hpp"
#include "shader/integration.hpp"

namespace gltfx::shader {
namespace {

// How much of an even light comes from facets that are seen under each cosine: by roughness, by
// cosine of the view, by cosine of the facet.
using FilmCurve = std::array<float, kFilmColumns>;
constexpr std::array<std::array<FilmCurve, kFilmColumns>, kFilmRows> kFilmWeights{{
#include "shader/tables/film_weights.inc"
}};
static_assert(kFilmColumns % kLanes == 0);

// The reflectance of a film at each cosine, by colour.
using FilmColors = std::array<FilmCurve, 3>;

struct RememberedFilm {
  Rgb f0;
  ThinFilm film;
  FilmColors colors{};

  bool is(const Fresnel& fresnel) const {
    const auto key = [](const Rgb& f, const ThinFilm& t) {
      return std::tuple(f.x, f.y, f.z, t.ior, t.thickness);
    };
    return key(f0, film) == key(fresnel.f0, fresnel.film);
  }
};

// A thread remembers one: the film of a material without textures of it.
const FilmColors& colors_of(const Fresnel& fresnel) {
  thread_local RememberedFilm last{Rgb(-1), {}, {}};
  if (last.is(fresnel)) return last.colors;
  last.f0 = fresnel.f0;
  last.film = fresnel.film;
  for (std::size_t i = 0; i < kFilmColumns; ++i) {
    const double cosine = std::max(film_cosine(static_cast<int>(i)), 1e-4);
    const Rgb reflectance = fresnel.iridescent(cosine);
    for (std::size_t c = 0; c < last.colors.size(); ++c)
      last.colors[c][i] = static_cast<float>(std::min(reflectance[static_cast<int>(c)], 1.0));
  }
  return last.colors;
}

double interpolated(const FilmCurve& curve, const TableCell& cell) {
  return static_cast<double>(
      sum_of(load_lanes(curve.data() + cell.first) * load_lanes(cell.weights.data())));
}

// Albedos of the table's lobes, by row and column, and the parts that rise with the angle.
struct IsotropicAlbedos {
  std::array<FilmCurve, kFilmRows> all{}, rising{};
};

const IsotropicAlbedos& isotropic_albedos() {
  static constinit MadeOnce<IsotropicAlbedos> albedos;
  return albedos.get([] {
    IsotropicAlbedos result;
    for (std::size_t r = 0; r < kFilmRows; ++r) {
      for (std::size_t i = 0; i < kFilmColumns; ++i) {
        float all = 0;
        float rising = 0;
        for (std::size_t k = 0; k < kFilmColumns; ++k) {
          const float weight = kFilmWeights[r][i][k];
          all += weight;
          rising += weight * static_cast<float>(pow5(1 - film_cosine(static_cast<int>(k))));
        }
        result.all[r][i] = all;
        result.rising[r][i] = rising / all;
      }
    }
    return result;
  });
}

// Where a value is between rows, of which each has less than the one before.
double row_of(const std::array<FilmCurve, kFilmRows>& rows, std::size_t column, double value) {
  const auto wanted = static_cast<float>(value);
  std::size_t row = 1;
  while (row + 1 < kFilmRows && rows[row][column] > wanted) ++row;
  const float before = rows[row - 1][column];
  const float range = before - rows[row][column];
  const float part = range > 0 ? std::clamp((before - wanted) / range, 0.0F, 1.0F) : 0;
  return static_cast<double>(row - 1) + static_cast<double>(part);
}

// The roughness of the isotropic lobe that is most like an anisotropic one: towards the horizon by
// the part of its albedo that rises, towards the front, where nothing rises, by all of it.
double like_isotropic(std::size_t column, const SpecularAlbedo& albedo) {
  const IsotropicAlbedos& rows = isotropic_albedos();
  const double all = albedo.constant + albedo.rising;
  const double front = std::clamp((film_cosine(static_cast<int>(column)) - 0.55) / 0.2, 0.0, 1.0);
  const double row = row_of(rows.rising, column, albedo.rising / all) * (1 - front) +
                     row_of(rows.all, column, all) * front;
  return row / (kFilmRows - 1);
}

// What the layer leaves over of each colour, for one cosine of the view. `albedo`: of the lobe, or
// null for that of the table.
std::array<float, 3> left_of(const FilmColors& colors, std::size_t column, const TableCell& row,
                             const float* albedo, const Rgb& bounced) {
  std::array<Lanes, 3> sum{};
  Lanes all{};
  for (std::size_t from = 0; from < kFilmColumns; from += kLanes) {
    Lanes weights{};
    for (std::size_t r = 0; r < row.weights.size(); ++r)
      weights += row.weights[r] * load_lanes(kFilmWeights[row.first + r][column].data() + from);
    for (std::size_t c = 0; c < colors.size(); ++c)
      sum[c] += weights * load_lanes(colors[c].data() + from);
    all += weights;
  }
  const float scale = albedo != nullptr ? *albedo / sum_of(all) : 1;
  const float once = std::clamp(sum_of(all) * scale, 0.05F, 1.0F);
  // Of the table and of reflectances between its cosines.
  constexpr float kMargin = 0.002F;
  std::array<float, 3> left{};
  for (std::size_t c = 0; c < left.size(); ++c) {
    const auto again = static_cast<float>(bounced[static_cast<int>(c)]);
    const float reflected = sum_of(sum[c]) * scale * (1 + again * (1 / once - 1));
    left[c] = std::clamp(1 - reflected - kMargin, 0.0F, 1.0F);
  }
  return left;
}

// Weights of the columns in the mean over a hemisphere.
const FilmCurve& mean_weights() {
  static constinit MadeOnce<FilmCurve> weights;
  return weights.get([] {
    FilmCurve sums{};
    for (const Node& node : gauss_legendre(64)) {
      const TableCell cell = film_column(std::sqrt(node.x));
      for (std::size_t i = 0; i < cell.weights.size(); ++i)
        sums[cell.first + i] += cell.weights[i] * static_cast<float>(node.weight);
    }
    return sums;
  });
}

// Weights of the azimuths of a layer in the mean over a hemisphere.
std::array<double, kAzimuthRows> azimuth_weights(const Microfacets& facets) {
  constexpr int kTurns = 12;  // in a quarter of one, which is like the others
  std::array<double, kAzimuthRows> sums{};
  for (int i = 0; i < kTurns; ++i) {
    const SinCos turn = sin_cos_of((i + 0.5) / (4 * kTurns));
    const TableCell cell =
        azimuth_row(azimuth_of(facets, facets.turned_back({turn.cosine, turn.sine, 0})));
    for (std::size_t k = 0; k < cell.weights.size(); ++k)
      sums[cell.first + k] += static_cast<double>(cell.weights[k]) / kTurns;
  }
  return sums;
}

}  // namespace

FilmLayer::FilmLayer(const Fresnel& fresnel, const Microfacets& facets,
                     const AnisotropicAlbedo* anisotropic, const Vec3d& v, const Rgb& bounced)
    : smooth_(facets.smooth()), anisotropic_(anisotropic) {
  const FilmColors& colors = colors_of(fresnel);
  std::array<double, kAzimuthRows> weights{1};
  if (anisotropic_ != nullptr) weights = azimuth_weights(facets);
  Rgb mean;
  for (std::size_t a = 0; a < (anisotropic_ != nullptr ? kAzimuthRows : 1); ++a) {
    for (std::size_t i = 0; i < kFilmColumns; ++i) {
      std::array<float, 3> left{};
      if (smooth_) {
        for (std::size_t c = 0; c < left.size(); ++c) left[c] = 1 - colors[c][i];
      } else if (anisotropic_ == nullptr) {
        left = left_of(colors, i, {std::sqrt(facets.alpha_b), kFilmRows}, nullptr, bounced);
      } else {
        const SpecularAlbedo albedo =
            anisotropic_->at(azimuth_part(static_cast<int>(a)), film_cosine(static_cast<int>(i)));
        const auto once = static_cast<float>(albedo.constant + albedo.rising);
        left = left_of(colors, i, {like_isotropic(i, albedo), kFilmRows}, &once, bounced);
      }
      for (std::size_t c = 0; c < left.size(); ++c) left_over_[a][c][i] = left[c];
      mean += Rgb(static_cast<double>(left[0]), static_cast<double>(left[1]),
                  static_cast<double>(left[2])) *
              (weights[a] * static_cast<double>(mean_weights()[i]));
    }
  }
  const Rgb seen = left_over(fresnel, v);
  const auto over = [](double left, double all) { return all > 0 ? left / all : 0; };
  scale_ = {over(seen.x, mean.x), over(seen.y, mean.y), over(seen.z, mean.z)};
}

Rgb FilmLayer::left_over(const Fresnel& fresnel, const Vec3d& direction) const {
  if (smooth_) return Rgb(1) - fresnel.iridescent(direction.z);
  const TableCell column = film_column(direction.z);
  const auto of_azimuth = [&](std::size_t a) {
    const Colors& colors = left_over_[a];
    return Rgb(interpolated(colors[0], column), interpolated(colors[1], column),
               interpolated(colors[2], column));
  };
  Rgb left;
  if (anisotropic_ == nullptr) {
    left = of_azimuth(0);
  } else {
    const TableCell azimuth = azimuth_row(azimuth_of(anisotropic_->facets(), direction));
    for (std::size_t k = 0; k < azimuth.weights.size(); ++k)
      left += of_azimuth(azimuth.first + k) * static_cast<double>(azimuth.weights[k]);
  }
  return {std::max(left.x, 0.0), std::max(left.y, 0.0), std::max(left.z, 0.0)};
}

}  // namespace gltfx::shader
