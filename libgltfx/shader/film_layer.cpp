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
      return std::tuple(f.x, f.y, f.z, t.ior, t.thickness, t.most);
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

double interpolated(const FilmCurve& curve, double cosine) {
  const TableCell cell = film_column(cosine);
  return static_cast<double>(
      sum_of(load_lanes(curve.data() + cell.first) * load_lanes(cell.weights.data())));
}

// The light of the strongest colour that the layer reflects, by cosine of the view.
FilmCurve reflected_by(const FilmColors& colors, double roughness, double bounced) {
  const TableCell row(roughness, kFilmRows);
  FilmCurve sums;
  for (std::size_t i = 0; i < kFilmColumns; ++i) {
    std::array<Lanes, 3> sum{};
    Lanes all{};
    for (std::size_t from = 0; from < kFilmColumns; from += kLanes) {
      Lanes weights{};
      for (std::size_t r = 0; r < row.weights.size(); ++r)
        weights += row.weights[r] * load_lanes(kFilmWeights[row.first + r][i].data() + from);
      for (std::size_t c = 0; c < colors.size(); ++c)
        sum[c] += weights * load_lanes(colors[c].data() + from);
      all += weights;
    }
    const float strongest = std::max({sum_of(sum[0]), sum_of(sum[1]), sum_of(sum[2])});
    const float once = std::clamp(sum_of(all), 0.05F, 1.0F);
    sums[i] = strongest * (1 + static_cast<float>(bounced) * (1 / once - 1));
  }
  return sums;
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

}  // namespace

FilmLayer::FilmLayer(const Fresnel& fresnel, const Microfacets& facets, const Vec3d& v,
                     double bounced)
    : smooth_(facets.smooth()) {
  // Of the table and of reflectances between its cosines.
  const float margin = smooth_ ? 0 : 0.002F;
  const FilmColors& colors = colors_of(fresnel);
  FilmCurve reflected = reflected_by(colors, std::sqrt(facets.alpha_b), bounced);
  if (!facets.isotropic()) {  // between the isotropic values of both
    const FilmCurve across = reflected_by(colors, std::sqrt(facets.alpha_t), bounced);
    for (std::size_t i = 0; i < kFilmColumns; ++i) reflected[i] = std::max(reflected[i], across[i]);
  }
  double mean = 0;
  for (std::size_t i = 0; i < kFilmColumns; ++i) {
    left_over_[i] = std::clamp(1 - reflected[i] - margin, 0.0F, 1.0F);
    mean += static_cast<double>(left_over_[i] * mean_weights()[i]);
  }
  scale_ = mean > 0 ? left_over(fresnel, v.z) / mean : 0;
}

double FilmLayer::left_over(const Fresnel& fresnel, double cosine) const {
  const double left =
      smooth_ ? 1 - max_value(fresnel.iridescent(cosine)) : interpolated(left_over_, cosine);
  return std::max(left, 0.0);
}

}  // namespace gltfx::shader
