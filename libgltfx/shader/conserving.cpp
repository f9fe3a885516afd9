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
  if (gloss <= 0 && m.transmission <= 0) return {};
  TintedBounces result{m.volumetric() ? MultipleScattering(fresnel, facets, v)
                                      : MultipleScattering(facets, v)};
  // What is neither reflected nor absorbed goes through a wall of glass at once.
  const Rgb opaque = result.bounces.tint(mean) * gloss;
  result.tint = opaque + (Rgb(1) - opaque) * m.transmission;
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
      isotropic_(facets.isotropic()),
      facets_(facets),
      narrow_(std::sqrt(facets.alpha_b)),
      wide_(isotropic_ ? narrow_ : SpecularCurve(std::sqrt(facets.alpha_t))),
      f90_(max_value(fresnel.f90)),
      bounced_(bounces.bounces.active() ? max_value(bounces.tint) : 0) {
  if (inside_) {
    share_v_ = share_inside(fresnel, facets, v, 1 + bounced_ * (bounces.scale(v) - 1));
    return;
  }
  f0_ = max_value(fresnel.f0);
  if (fresnel.film.strength > 0)
    film_ = std::make_unique<const FilmLayer>(fresnel, facets, v, bounced_);
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

inline double EnergyCompensation::share(const SpecularCurve& curve, double cosine) const {
  return share(curve.at(albedo_column(cosine)), diffuse_fresnel(cosine), table_margin(cosine));
}

// The albedo of an anisotropic lobe is about that of an isotropic one with the roughness under the
// azimuth.
inline double EnergyCompensation::share(const Vec3d& direction) const {
  if (isotropic_) return share(narrow_, direction.z);
  return share(SpecularCurve(std::sqrt(facets_.under_azimuth(direction))), direction.z);
}

double EnergyCompensation::mean_share() const {
  static constinit MadeOnce<GrazingLights> made_lights;
  static constinit MadeOnce<SpecularColumns> made_columns;
  const GrazingLights& lights = made_lights.get(make_grazing_lights);
  const SpecularColumns& columns = made_columns.get([&] { return SpecularColumns(lights.cosine); });
  const SpecularColumns::Albedos narrow = narrow_.at(columns);
  const SpecularColumns::Albedos wide = isotropic_ ? narrow : wide_.at(columns);
  double sum = 0;
  double all = 0;
  double sum_front = 0;
  double all_front = 0;
  for (std::size_t i = 0; i < GrazingLights::kCount; ++i) {
    double shared =
        share({narrow.constant[i], narrow.rising[i]}, lights.diffuse[i], lights.margin[i]);
    if (!isotropic_) {
      constexpr double kMore = 0.95;  // nearer to the greater, so that no light is gained
      const double across =
          share({wide.constant[i], wide.rising[i]}, lights.diffuse[i], lights.margin[i]);
      shared = kMore * std::max(shared, across) + (1 - kMore) * std::min(shared, across);
    }
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
  if (!active_) return 1;
  return inside_ ? share_v_ : share_v_ * share(l) * scale_;
}

SheenScaling::SheenScaling(const Rgb& color, double sheen_roughness, const Microfacets& facets,
                           const Vec3d& v, ShaderMode mode)
    : strength(max_value(color)),
      roughness(sheen_roughness),
      conserving(mode == ShaderMode::conserving) {
  if (strength <= 0) return;
  curve = SheenCurve(roughness);
  albedo_v = curve.at(v.z);
  mean_ = 1 - std::min(strength * curve.mean(), 1.0);
  base_roughness_ = std::sqrt(std::sqrt(facets.alpha_t * facets.alpha_b));
  gloss_v_ = glossy(v.z, std::max(1 - reflected(albedo_v), 0.0));
}

// Nearly upright fibres give a curve too steep for the table.
double SheenScaling::reflected(double albedo) const {
  return strength * albedo * (roughness < 0.1 ? 1.05 : 1.002);
}

double SheenScaling::glossy(double cosine, double left) const {
  // Fits to furnaces: of white metal of any roughness, the sum is then 1 to some 0.03.
  const double front = square(base_roughness_);
  const double grazing = 1 - pow5(1 - front);
  return left + (mean_ - left) * (grazing + (front - grazing) * cosine);
}

SheenScaling::Weights SheenScaling::weights(double n_l) const {
  const double albedo_l = curve.at(n_l);
  if (!conserving) {
    const double base = std::max(0.0, 1 - strength * std::max(albedo_v, albedo_l));
    return {1, base, base};
  }
  const double reflected_v = reflected(albedo_v);
  const double reflected_l = reflected(albedo_l);
  const double left_v = std::max(1 - reflected_v, 0.0);
  const double left_l = std::max(1 - reflected_l, 0.0);
  const double both = left_v * left_l;
  if (!(both > 0)) return {1 / std::max({1.0, reflected_v, reflected_l}), 0, 0};
  // Diffuse light below a smooth layer has a higher mean; that of gloss is an estimate.
  constexpr double kDiffuse = 0.992;
  constexpr double kGloss = 0.98;
  return {1 / std::max({1.0, reflected_v, reflected_l}), kDiffuse * both / mean_,
          kGloss * both / std::sqrt(gloss_v_ * glossy(n_l, left_l))};
}

}  // namespace gltfx::shader
