// SPDX-License-Identifier: Apache-2.0
#include "shader/conserving.hpp"

#include <algorithm>
#include <vector>

#include "base/fork.hpp"
#include "shader/albedo.hpp"
#include "shader/albedo_inside.hpp"
#include "shader/integration.hpp"

namespace gltfx::shader {
namespace {

// More than the error of the tables where a layer reflects most. Plastics of F0 0.04 to 0.8 and of
// any roughness then reflect 0.9996 of all light at most.
double table_margin(double cosine) { return 3e-5 / (cosine + 0.001); }

// Lights over a hemisphere, for a grazing view.
struct GrazingLights {
  static constexpr std::size_t kCount = SpecularColumns::kCount;
  using Values = std::array<double, kCount>;
  Values cosine{}, weight{};
  Values fresnel{};            // mean of (1 - V.H)^5 over a turn
  Values front{};              // the same for a view from the front
  Values diffuse{}, margin{};  // by cosine
  std::array<TableCell, kCount> column{};
};

GrazingLights make_grazing_lights() {
  constexpr int kTurns = 64;
  const std::vector<Node> nodes = gauss_legendre(GrazingLights::kCount);
  GrazingLights lights;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double cosine = std::sqrt(nodes[i].x);
    lights.cosine[i] = cosine;
    lights.weight[i] = nodes[i].weight;
    lights.diffuse[i] = diffuse_fresnel(cosine);
    lights.column[i] = scale_column(cosine);
    lights.margin[i] = table_margin(cosine);
    lights.front[i] = pow5(1 - std::sqrt((1 + cosine) / 2));
    for (int turn = 0; turn < kTurns; ++turn) {
      const double v_l = std::sqrt(1 - nodes[i].x) * std::cos(pi * (turn + 0.5) / kTurns);
      lights.fresnel[i] += pow5(1 - std::sqrt((1 + v_l) / 2)) / kTurns;
    }
  }
  return lights;
}

// Of a layer that reflects all light once.
double albedo_of(const SpecularAlbedo& albedo) {
  return std::clamp(albedo.constant + albedo.rising, 0.05, 1.0);
}

}  // namespace

TintedBounces dielectric_bounces(const Fresnel& fresnel, const Microfacets& facets, const Vec3d& v,
                                 const Material& m, ShaderMode mode) {
  if (mode != ShaderMode::conserving || m.metallic >= 1 || facets.smooth()) return {};
  // Where little is reflected, more bounces add less than 0.002 of all light: to no material of an
  // index up to 1.5.
  constexpr double kDull = 0.1;
  const Rgb mean = mean_reflectance(fresnel);
  const double gloss = std::clamp(max_value(mean) / kDull - 1, 0.0, 1.0);
  const bool scatters = m.scattering == Scattering::unified && !m.volumetric();
  const double clear = m.transmission * (scatters ? 1 - m.scatter_strength : 1);
  if (gloss <= 0 && clear <= 0) return {};
  TintedBounces result{m.volumetric() ? MultipleScattering(fresnel, facets, v)
                                      : MultipleScattering(facets, v)};
  // What is neither reflected nor absorbed goes through a wall of glass at once.
  result.opaque = result.bounces.tint(mean) * gloss;
  result.tint = result.opaque + (Rgb(1) - result.opaque) * clear;
  return result;
}

TintedBounces conductor_bounces(const Fresnel& fresnel, const Microfacets& facets, const Vec3d& v,
                                const Material& m, ShaderMode mode) {
  if (mode != ShaderMode::conserving || m.metallic <= 0 || facets.smooth()) return {};
  TintedBounces result{MultipleScattering(facets, v)};
  result.tint = result.bounces.tint(mean_reflectance(fresnel));
  return result;
}

EnergyCompensation::EnergyCompensation(const Fresnel& fresnel, const Microfacets& facets,
                                       const Vec3d& v, const TintedBounces& bounces)
    : active_(true),
      inside_(fresnel.eta < 1),
      f90_(max_value(fresnel.f90)),
      bounced_(max_value(bounces.opaque)) {
  if (inside_) {
    inside_share_ =
        share_inside(fresnel, facets, v, Rgb(1) + bounces.opaque * (bounces.scale(v) - 1));
    return;
  }
  if (facets.isotropic()) {
    curve_ = SpecularCurve(std::sqrt(facets.alpha_b));
  } else {
    anisotropic_ = std::make_unique<const AnisotropicAlbedo>(facets);
  }
  f0_ = max_value(fresnel.f0);
  if (fresnel.film.strength > 0)
    film_ =
        std::make_unique<const FilmLayer>(fresnel, facets, anisotropic_.get(), v, bounces.opaque);
  share_v_ = share(v);
  scale_ = 1 / mean_share();
}

inline double EnergyCompensation::share(const SpecularAlbedo& albedo, double diffuse,
                                        double margin) const {
  double reflected = f0_ * albedo.constant + f90_ * (albedo.rising + margin);
  if (bounced_ > 0) reflected *= 1 + bounced_ * (1 / albedo_of(albedo) - 1);
  constexpr double kMost = 4;  // more than any layer needs that has a base to speak of
  const double left = 1 - reflected;
  const double handed_on = 1 - f0_ - (f90_ - f0_) * diffuse;
  return handed_on > 0 ? std::clamp(left / handed_on, 0.0, kMost) : 1;
}

inline double EnergyCompensation::share(const Vec3d& direction) const {
  const double cosine = direction.z;
  const SpecularAlbedo albedo = anisotropic_ ? anisotropic_->at(direction) : curve_.at(cosine);
  return share(albedo, diffuse_fresnel(cosine), table_margin(cosine));
}

double EnergyCompensation::mean_share() const {
  static constinit MadeOnce<GrazingLights> made_lights;
  static constinit MadeOnce<SpecularColumns> made_columns;
  const GrazingLights& lights = made_lights.get(make_grazing_lights);
  const SpecularColumns& columns = made_columns.get([&] { return SpecularColumns(lights.cosine); });
  const SpecularColumns::Albedos albedos =
      anisotropic_ ? SpecularColumns::Albedos() : curve_.at(columns);
  double sum = 0;
  double all = 0;
  double sum_front = 0;
  double all_front = 0;
  for (std::size_t i = 0; i < GrazingLights::kCount; ++i) {
    const SpecularAlbedo albedo = anisotropic_
                                      ? anisotropic_->mean_at(lights.column[i])
                                      : SpecularAlbedo{albedos.constant[i], albedos.rising[i]};
    const double shared = share(albedo, lights.diffuse[i], lights.margin[i]);
    const double passed = lights.weight[i] * (1 - f0_ - (f90_ - f0_) * lights.fresnel[i]);
    sum += passed * shared;
    all += passed;
    const double passed_front = lights.weight[i] * (1 - f0_ - (f90_ - f0_) * lights.front[i]);
    sum_front += passed_front * shared;
    all_front += passed_front;
  }
  const double margin = 1 + 0.003 * f90_;  // for so few points
  return all > 0 && all_front > 0 ? std::max(sum / all, sum_front / all_front) * margin : 1;
}

[[gnu::flatten]] double EnergyCompensation::factor(const Vec3d& l) const {
  return active_ ? share_v_ * share(l) * scale_ : 1;
}

}  // namespace gltfx::shader
