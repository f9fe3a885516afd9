// SPDX-License-Identifier: Apache-2.0
#include "shader/multiple_scattering.hpp"

#include <algorithm>

#include "shader/albedo_inside.hpp"

namespace gltfx::shader {
namespace {

constexpr std::array<float, kSpecularRows> kMeanAlbedo{
#include "shader/tables/mean_albedo.inc"
};
// Of a facet that reflects nothing but totally, and what F0 and F90 add.
using GlassAlbedo = std::array<std::array<float, kGlassColumns>, kGlassRows>;
using GlassParts = std::array<std::array<std::array<GlassAlbedo, 3>, 2>, kGlassIors>;
constexpr GlassParts kGlass{{
#include "shader/tables/glass_albedo.inc"
}};

// The tables are that close to quadratures where a lobe reflects or transmits all light.
constexpr double kAnisotropicMargin = 0.004;
constexpr double kGlassMargin = 0.004;
constexpr double kInsideMargin = 0.009;  // where total reflection begins within a cell

double glass_albedo(const Fresnel& fresnel, double roughness, double cosine) {
  const double ratio = std::max(fresnel.eta, 1 / fresnel.eta);
  const double root = std::sqrt(std::min(2 * (ratio - 1) / (ratio + 1), 1.0));
  const TableCell ior(root, kGlassIors);
  const TableCell row(roughness, kGlassRows);
  const TableCell column = cosine_column(cosine, kGlassColumns);
  const std::array<float, 3> by{1, static_cast<float>(max_value(fresnel.f0)),
                                static_cast<float>(max_value(fresnel.f90))};
  const std::size_t side = fresnel.eta < 1 ? 1 : 0;
  Lanes sum{};
  for (std::size_t i = 0; i < ior.weights.size(); ++i) {
    for (std::size_t part = 0; part < by.size(); ++part) {
      const GlassAlbedo& rows = kGlass[ior.first + i][side][part];
      sum += ior.weights[i] * by[part] * interpolated_lanes(rows, row, column.first);
    }
  }
  return static_cast<double>(sum_of(sum * load_lanes(column.weights.data())));
}

}  // namespace

MultipleScattering::MultipleScattering(const Microfacets& facets, const Vec3d& v) {
  if (facets.smooth()) return;
  if (facets.isotropic()) {
    kind_ = Kind::isotropic;
    const double roughness = std::sqrt(facets.alpha_b);
    curve_ = SpecularCurve(roughness);
    scale_v_ = curve_.scale(v.z);
    mean_albedo_ = interpolated(kMeanAlbedo, {roughness, kSpecularRows});
  } else {
    kind_ = Kind::anisotropic;
    anisotropic_ = std::make_unique<const AnisotropicScale>(facets);
    scale_v_ = anisotropic_->at(v) * (1 - kAnisotropicMargin);
    mean_albedo_ = anisotropic_->mean_albedo();
  }
}

MultipleScattering::MultipleScattering(const Fresnel& fresnel, const Microfacets& facets,
                                       const Vec3d& v) {
  if (facets.smooth() || std::fabs(fresnel.eta - 1) < 1e-9) return;
  kind_ = Kind::refracting;
  const bool in_table = facets.isotropic() && fresnel.film.strength <= 0;
  const double albedo = in_table ? glass_albedo(fresnel, std::sqrt(facets.alpha_b), v.z)
                                 : summed_albedo(fresnel, facets, v);
  const double margin = fresnel.eta < 1 ? kInsideMargin : kGlassMargin;
  scale_v_ = (1 - margin) / std::clamp(albedo, 0.1, 1.0);
}

Rgb mean_reflectance(const Fresnel& fresnel) {
  const Rgb plain = fresnel.f0 + (fresnel.f90 - fresnel.f0) * (1.0 / 21);
  if (fresnel.film.strength <= 0) return plain;
  // One cosine in the middle: the colour of what bounces needs no more.
  const Rgb film = fresnel.iridescent(0.7071067812);
  return plain * (1 - fresnel.film.strength) + film * fresnel.film.strength;
}

}  // namespace gltfx::shader
