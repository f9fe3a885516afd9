// SPDX-License-Identifier: Apache-2.0
#include "shader/sheen_scaling.hpp"

#include <algorithm>

#include "base/fork.hpp"
#include "shader/integration.hpp"

namespace gltfx::shader {
namespace {

using HeldRow = std::array<float, kAlbedoColumns>;
using HeldTable = std::array<HeldRow, kHeldSheenRows>;
constexpr HeldTable kHeldAlbedo{{
#include "shader/tables/held_sheen_albedo.inc"
}};
constexpr HeldTable kHeldScale{{
#include "shader/tables/held_sheen_scale.inc"
}};
using BelowStrengths = std::array<std::array<float, kBelowColumns>, kBelowStrengths>;
constexpr std::array<std::array<BelowStrengths, kBelowBaseRows>, kBelowSheenRows> kBelow{{
#include "shader/tables/below_sheen.inc"
}};

// m of gloss below a sheen. `sheen`: its row.
double mean_of_gloss(const TableCell& sheen, double strength, double alpha, double cosine) {
  const TableCell base = below_base_row(alpha);
  const TableCell column = below_column(cosine);
  // The parabola through 1 at strength 0 and the values of the table.
  const auto s = static_cast<float>(std::min(strength, 1.0));
  const std::array<float, kBelowStrengths> by{4 * s * (1 - s), s * (2 * s - 1)};
  Lanes sums = Lanes{} + (1 - by[0] - by[1]);
  for (std::size_t i = 0; i < sheen.weights.size(); ++i) {
    for (std::size_t j = 0; j < base.weights.size(); ++j) {
      for (std::size_t k = 0; k < by.size(); ++k)
        sums += sheen.weights[i] * base.weights[j] * by[k] *
                load_lanes(kBelow[sheen.first + i][base.first + j][k].data() + column.first);
    }
  }
  const float mean = sum_of(sums * load_lanes(column.weights.data()));
  return std::clamp(static_cast<double>(mean), 1e-4, 1.0);
}

}  // namespace

double HeldSheen::scale(double cosine) const {
  return interpolated(kHeldScale, row_, albedo_column(cosine));
}

double HeldSheen::albedo(double cosine) const {
  return std::clamp(interpolated(kHeldAlbedo, row_, albedo_column(cosine)), 0.0, 1.0);
}

double HeldSheen::mean() const {
  using Means = std::array<float, kHeldSheenRows>;
  static constinit MadeOnce<Means> means;
  const Means& rows = means.get([] {
    Means sums{};
    for (const Node& node : gauss_legendre(64)) {
      const TableCell column = albedo_column(std::sqrt(node.x));
      for (std::size_t r = 0; r < sums.size(); ++r)
        sums[r] += static_cast<float>(node.weight * interpolated(kHeldAlbedo[r], column));
    }
    return sums;
  });
  return interpolated(rows, row_);
}

SheenScaling::SheenScaling(const Material& m, const Vec3d& v, ShaderMode mode)
    : strength_(max_value(m.sheen_color)), conserving_(mode == ShaderMode::conserving) {
  if (strength_ <= 0) return;
  if (!conserving_) {
    curve_ = SheenCurve(m.sheen_roughness);
    albedo_v_ = curve_.at(v.z);
    return;
  }
  held_ = HeldSheen(m.sheen_roughness);
  albedo_v_ = held_.albedo(v.z);
  scale_v_ = held_.scale(v.z);
  below_ = held_sheen_row(m.sheen_roughness, kBelowSheenRows);
  facets_ = microfacets(m.roughness, m.anisotropy, m.anisotropy_rotation);
  const double left_v = left(albedo_v_);
  const double mean = std::min(strength_ * held_.mean(), 0.99);
  // Fits to furnaces. Light below a layer comes less from grazing angles, where the sheen takes
  // most; the rougher the layer, the less it differs.
  const double wide = std::min(4 * mean, 1.0);
  const double below_layer = 1 - 0.011 * (1 - std::sqrt(facets_.widest())) * wide;
  const double rough = m.diffuse_roughness * strength_ * (2 - std::min(strength_, 1.0));
  grazing_ = rough * (0.006 + 0.022 * wide + 0.004 * m.specular);
  front_ = rough * (0.008 + 0.034 * wide);
  diffuse_v_ = below_layer * left_for_diffuse(left_v, v.z) / (1 - mean);
  gloss_v_ = left_for_gloss(left_v, v);
}

double SheenScaling::left(double albedo) const {
  constexpr double kMargin = 1.001;  // of the table
  return std::max(1 - kMargin * strength_ * albedo, 0.0);
}

double SheenScaling::left_for_diffuse(double left, double cosine) const {
  // Rough diffuse surfaces send light back to where it comes from.
  return left * (1 + grazing_ - front_ * cosine);
}

double SheenScaling::left_for_gloss(double left, const Vec3d& direction) const {
  double alpha = facets_.alpha_b;
  if (!facets_.isotropic()) {  // from the side the roughness under the azimuth, from the front both
    const double side = facets_.under_azimuth(direction);
    const double front = std::sqrt(facets_.alpha_t * facets_.alpha_b);
    alpha = side + (front - side) * square(direction.z);
    left *= 0.9985;  // which is an estimate
  }
  return left / std::sqrt(mean_of_gloss(below_, strength_, alpha, direction.z));
}

SheenScaling::Weights SheenScaling::weights(const Vec3d& l) const {
  if (!conserving_) {
    const double base = std::max(0.0, 1 - strength_ * std::max(albedo_v_, curve_.at(l.z)));
    return {1, base, base};
  }
  const double left_l = left(held_.albedo(l.z));
  return {scale_v_ * held_.scale(l.z), diffuse_v_ * left_for_diffuse(left_l, l.z),
          gloss_v_ * left_for_gloss(left_l, l)};
}

}  // namespace gltfx::shader
