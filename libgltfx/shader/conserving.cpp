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

// Schlick's curve through a point: its F0 when it ends at `f90`.
double f0_through(double reflectance, double f90, double cosine) {
  const double w = pow5(1 - cosine);
  return (reflectance - f90 * w) / (1 - w);
}

// More than the error of the tables where a layer reflects most. Plastics of F0 0.04 to 0.8 and of
// any roughness then reflect 0.9996 of all light at most.
double table_margin(double cosine) { return 3e-5 / (cosine + 0.001); }

// Lights over a hemisphere, for a grazing view.
struct GrazingLights {
  static constexpr std::size_t kCount = SpecularColumns::kCount;
  using Values = std::array<double, kCount>;
  Values cosine{}, weight{};
  Values fresnel{};            // mean of (1 - V.H)^5 over a turn
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
    for (int turn = 0; turn < kTurns; ++turn) {
      const double v_l = std::sqrt(1 - nodes[i].x) * std::cos(pi * (turn + 0.5) / kTurns);
      lights.fresnel[i] += pow5(1 - std::sqrt((1 + v_l) / 2)) / kTurns;
    }
  }
  return lights;
}

}  // namespace

EnergyCompensation::EnergyCompensation(const Fresnel& fresnel, const Microfacets& facets,
                                       const Vec3d& v)
    : active_(true),
      inside_(fresnel.eta < 1),
      isotropic_(facets.isotropic()),
      along_(std::sqrt(facets.alpha_b)),
      across_(isotropic_ ? along_ : SpecularCurve(std::sqrt(facets.alpha_t))),
      f90_(max_value(fresnel.f90)) {
  if (inside_) {
    share_v_ = share_inside(fresnel, facets, v);
    return;
  }
  highest_f0_ = lowest_f0_ = max_value(fresnel.f0);
  if (fresnel.film.strength > 0) {
    f90_ = 1;
    constexpr int kSteps = 12;
    for (int i = 0; i <= kSteps; ++i) {
      const double t = static_cast<double>(i) / kSteps;
      const double cosine = 0.015 + 0.985 * t * std::sqrt(t);
      const double f0 = f0_through(max_value(fresnel.at(cosine)), f90_, cosine);
      highest_f0_ = std::clamp(f0, highest_f0_, 1.0);
      lowest_f0_ = std::clamp(f0, 0.0, lowest_f0_);
    }
  }
  share_v_ = share(v.z);
  scale_ = 1 / mean_share();
}

inline double EnergyCompensation::share(const SpecularAlbedo& along, const SpecularAlbedo& across,
                                        double diffuse, double margin) const {
  double reflected = highest_f0_ * along.constant + f90_ * (along.rising + margin);
  if (!isotropic_) {  // between the isotropic values of both, except at grazing angles
    reflected = std::max(reflected, highest_f0_ * across.constant + f90_ * across.rising) +
                4 * f90_ * margin;
  }
  const double left = 1 - reflected;
  const double handed_on = 1 - lowest_f0_ - (f90_ - lowest_f0_) * diffuse;
  return handed_on > 0 ? std::clamp(left / handed_on, 0.0, 1.0) : 1;
}

inline double EnergyCompensation::share(double cosine) const {
  const TableCell column = albedo_column(cosine);
  const SpecularAlbedo along = along_.at(column);
  const SpecularAlbedo across = isotropic_ ? along : across_.at(column);
  return share(along, across, diffuse_fresnel(cosine), table_margin(cosine));
}

double EnergyCompensation::mean_share() const {
  static constinit MadeOnce<GrazingLights> made_lights;
  static constinit MadeOnce<SpecularColumns> made_columns;
  const GrazingLights& lights = made_lights.get(make_grazing_lights);
  const SpecularColumns& columns = made_columns.get([&] { return SpecularColumns(lights.cosine); });
  const SpecularColumns::Albedos along = along_.at(columns);
  const SpecularColumns::Albedos across = isotropic_ ? along : across_.at(columns);
  double sum = 0;
  double all = 0;
  for (std::size_t i = 0; i < GrazingLights::kCount; ++i) {
    const double passed =
        lights.weight[i] * (1 - lowest_f0_ - (f90_ - lowest_f0_) * lights.fresnel[i]);
    sum +=
        passed * share({along.constant[i], along.rising[i]}, {across.constant[i], across.rising[i]},
                       lights.diffuse[i], lights.margin[i]);
    all += passed;
  }
  constexpr double kMargin = 1.003;  // for so few points
  return all > 0 ? std::min(1.0, sum / all * kMargin) : 1;
}

[[gnu::flatten]] double EnergyCompensation::factor(double n_l) const {
  if (!active_) return 1;
  return inside_ ? share_v_ : share_v_ * share(n_l) * scale_;
}

SheenScaling::SheenScaling(const Rgb& color, double sheen_roughness, const Vec3d& v,
                           ShaderMode mode)
    : strength(max_value(color)),
      roughness(sheen_roughness),
      conserving(mode == ShaderMode::conserving) {
  if (strength <= 0) return;
  curve = SheenCurve(roughness);
  albedo_v = curve.at(v.z);
}

SheenScaling::Weights SheenScaling::weights(double n_l) const {
  double highest = strength * std::max(albedo_v, curve.at(n_l));
  // Nearly upright fibres give a curve too steep for the table.
  if (conserving) highest *= roughness < 0.1 ? 1.05 : 1.002;
  return {conserving ? 1 / std::max(1.0, highest) : 1, std::max(0.0, 1 - highest)};
}

}  // namespace gltfx::shader
