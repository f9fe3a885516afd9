// SPDX-License-Identifier: Apache-2.0
#include "shader/film_layer.hpp"

#include <algorithm>

#include "base/fork.hpp"
#include "base/lanes.hpp"
#include "base/remembered.hpp"
#include "shader/film_weights.hpp"
#include "shader/integration.hpp"

namespace gltfx::shader {
namespace {

// The reflectance of a film at each cosine, by colour.
using FilmColors = std::array<FilmCurve, 3>;

struct FilmKey {
  Rgb f0;
  double ior = 0, thickness = 0;
  bool operator==(const FilmKey&) const = default;
};

struct LayerKey {
  FilmKey film;
  double along = 0, across = 0;
  Rgb bounced;
  bool operator==(const LayerKey&) const = default;
};

FilmKey key_of(const Fresnel& fresnel) {
  return {fresnel.f0, fresnel.film.ior, fresnel.film.thickness};
}

std::shared_ptr<const FilmColors> colors_of(const Fresnel& fresnel) {
  thread_local Remembered<FilmKey, FilmColors, 2> known;
  return known.get(key_of(fresnel), [&fresnel] {
    FilmColors colors{};
    for (std::size_t i = 0; i < kFilmColumns; ++i) {
      const double cosine = std::max(film_cosine(static_cast<int>(i)), 1e-4);
      const Rgb reflectance = fresnel.iridescent(cosine);
      for (std::size_t c = 0; c < colors.size(); ++c)
        colors[c][i] = static_cast<float>(std::min(reflectance[static_cast<int>(c)], 1.0));
    }
    return colors;
  });
}

// What the layer leaves over of each colour, for one cosine of the view. `albedo`: of the lobe, or
// null for that of the weights.
std::array<float, 3> left_of(const FilmColors& colors, const FilmCurve& weights,
                             const float* albedo, const Rgb& bounced) {
  std::array<Lanes, 3> sum{};
  Lanes all{};
  for (std::size_t from = 0; from < kFilmColumns; from += kLanes) {
    const Lanes part = load_lanes(weights.data() + from);
    for (std::size_t c = 0; c < colors.size(); ++c)
      sum[c] += part * load_lanes(colors[c].data() + from);
    all += part;
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

}  // namespace

FilmLayer::LeftOver FilmLayer::make(const Fresnel& fresnel, const Microfacets& facets,
                                    const AnisotropicAlbedo* anisotropic, const Rgb& bounced) {
  const auto colors = colors_of(fresnel);
  std::array<float, kAzimuthRows> shares{1};
  std::shared_ptr<const AnisotropicFilmWeights> all_weights;
  FilmWeightRows rows;
  if (anisotropic != nullptr) {
    shares = azimuth_weights(facets);
    all_weights = anisotropic_film_weights(facets);
  } else if (!facets.smooth()) {
    rows = film_weights(std::sqrt(facets.alpha_b));
  }
  LeftOver result;
  for (std::size_t a = 0; a < (anisotropic != nullptr ? kAzimuthRows : 1); ++a) {
    for (std::size_t i = 0; i < kFilmColumns; ++i) {
      std::array<float, 3> left{};
      if (facets.smooth()) {
        for (std::size_t c = 0; c < left.size(); ++c) left[c] = 1 - (*colors)[c][i];
      } else if (anisotropic == nullptr) {
        left = left_of(*colors, rows[i], nullptr, bounced);
      } else {
        const SpecularAlbedo albedo =
            anisotropic->at(azimuth_part(static_cast<int>(a)), film_cosine(static_cast<int>(i)));
        const auto once = static_cast<float>(albedo.constant + albedo.rising);
        left = left_of(*colors, (*all_weights)[a][i], &once, bounced);
      }
      for (std::size_t c = 0; c < left.size(); ++c) result.at[a][c][i] = left[c];
      result.mean += Rgb(static_cast<double>(left[0]), static_cast<double>(left[1]),
                         static_cast<double>(left[2])) *
                     static_cast<double>(shares[a] * mean_weights()[i]);
    }
  }
  return result;
}

FilmLayer::FilmLayer(const Fresnel& fresnel, const Microfacets& facets,
                     const AnisotropicAlbedo* anisotropic, const Vec3d& v, const Rgb& bounced)
    : facets_(facets) {
  thread_local Remembered<LayerKey, LeftOver, 4> known;
  left_over_ = known.get({key_of(fresnel), facets.alpha_t, facets.alpha_b, bounced},
                         [&] { return make(fresnel, facets, anisotropic, bounced); });
  const Rgb seen = left_over(fresnel, v);
  const Rgb& mean = left_over_->mean;
  const auto over = [](double left, double all) { return all > 0 ? left / all : 0; };
  scale_ = {over(seen.x, mean.x), over(seen.y, mean.y), over(seen.z, mean.z)};
}

Rgb FilmLayer::left_over(const Fresnel& fresnel, const Vec3d& direction) const {
  if (facets_.smooth()) return Rgb(1) - fresnel.iridescent(direction.z);
  const TableCell column = film_column(direction.z);
  const auto of_azimuth = [&](std::size_t a) {
    const auto& colors = left_over_->at[a];
    return Rgb(interpolated(colors[0], column), interpolated(colors[1], column),
               interpolated(colors[2], column));
  };
  Rgb left;
  if (facets_.isotropic()) {
    left = of_azimuth(0);
  } else {
    const TableCell azimuth = azimuth_row(azimuth_of(facets_, direction));
    for (std::size_t k = 0; k < azimuth.weights.size(); ++k)
      left += of_azimuth(azimuth.first + k) * static_cast<double>(azimuth.weights[k]);
  }
  return {std::max(left.x, 0.0), std::max(left.y, 0.0), std::max(left.z, 0.0)};
}

}  // namespace gltfx::shader
