// SPDX-License-Identifier: Apache-2.0
#include "render/tone_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/tonemap.hpp"

namespace gltfx::render {
namespace {

using ColorMatrix = std::array<Float3, 3>;  // rows

float positive(float value) { return std::isfinite(value) ? std::clamp(value, 0.0F, 1e6F) : 0.0F; }

Float3 times(const ColorMatrix& m, const Float3& c) {
  Float3 product{};
  for (std::size_t row = 0; row < 3; ++row) {
    product[row] = m[row][0] * c[0] + m[row][1] * c[1] + m[row][2] * c[2];
  }
  return product;
}

template <class Function>
Float3 each(Float3 color, const Function& function) {
  for (float& part : color) part = function(part);
  return color;
}

Float3 clipped(const Float3& color) {
  return each(color, [](float part) { return std::clamp(part, 0.0F, 1.0F); });
}

// https://github.com/TheRealMJP/BakingLab/blob/master/BakingLab/ACES.hlsl: sRGB to AP1 with the
// saturation of the reference rendering transform, a fit of both curves, and back.
Float3 aces(const Float3& radiance) {
  static constexpr ColorMatrix kIn{{{0.59719F, 0.35458F, 0.04823F},
                                    {0.07600F, 0.90834F, 0.01566F},
                                    {0.02840F, 0.13383F, 0.83777F}}};
  static constexpr ColorMatrix kOut{{{1.60475F, -0.53108F, -0.07367F},
                                     {-0.10208F, 1.10813F, -0.00605F},
                                     {-0.00327F, -0.07276F, 1.07602F}}};
  constexpr float kExposure = 1 / 0.6F;
  const Float3 exposed = each(radiance, [](float part) { return part * kExposure; });
  const Float3 fitted = each(times(kIn, exposed), [](float v) {
    return (v * (v + 0.0245786F) - 0.000090537F) / (v * (0.983729F * v + 0.4329510F) + 0.238081F);
  });
  return clipped(times(kOut, fitted));
}

// The sigmoid: https://iolite-engine.com/blog_posts/minimal_agx_implementation. The matrices in
// Rec. 2020: https://github.com/google/filament/pull/7236.
Float3 agx(const Float3& radiance) {
  static constexpr ColorMatrix kToRec2020{
      {{0.6274F, 0.3293F, 0.0433F}, {0.0691F, 0.9195F, 0.0113F}, {0.0164F, 0.0880F, 0.8956F}}};
  static constexpr ColorMatrix kFromRec2020{{{1.6605F, -0.5876F, -0.0728F},
                                             {-0.1246F, 1.1329F, -0.0083F},
                                             {-0.0182F, -0.1006F, 1.1187F}}};
  static constexpr ColorMatrix kInset{{{0.856627153F, 0.095121241F, 0.048251606F},
                                       {0.137318973F, 0.761241991F, 0.101439036F},
                                       {0.111898213F, 0.076799419F, 0.811302368F}}};
  static constexpr ColorMatrix kOutset{{{1.127100582F, -0.110606643F, -0.016493939F},
                                        {-0.141329763F, 1.157823702F, -0.016493939F},
                                        {-0.141329763F, -0.110606643F, 1.251936407F}}};
  constexpr float kLeast = -12.47393F;  // stops: 10 below and 6.5 above a grey of 0.18
  constexpr float kGreatest = 4.026069F;
  const Float3 shaped = each(times(kInset, times(kToRec2020, radiance)), [](float part) {
    const float stops = std::log2(std::max(part, 1e-10F));
    const float x = std::clamp((stops - kLeast) / (kGreatest - kLeast), 0.0F, 1.0F);
    return ((((((15.5F * x - 40.14F) * x + 31.96F) * x - 6.868F) * x + 0.4298F) * x + 0.1191F) *
            x) -
           0.00232F;
  });
  const Float3 linear =
      each(times(kOutset, shaped), [](float part) { return std::pow(std::max(part, 0.0F), 2.2F); });
  return clipped(times(kFromRec2020, linear));
}

}  // namespace

Float3 tone_map(const Float3& radiance, ToneCurve curve) {
  if (curve == ToneCurve::neutral) return tone_map(radiance);
  const Float3 light = each(radiance, positive);
  switch (curve) {
    case ToneCurve::aces:
      return aces(light);
    case ToneCurve::agx:
      return agx(light);
    case ToneCurve::none:
      return clipped(light);
    case ToneCurve::neutral:
      break;
  }
  return tone_map(radiance);
}

}  // namespace gltfx::render
