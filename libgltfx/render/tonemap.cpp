// SPDX-License-Identifier: Apache-2.0
#include "render/tonemap.hpp"

#include <algorithm>
#include <cmath>

namespace gltfx::render {
namespace {

float sane(float value) { return std::isfinite(value) ? std::clamp(value, 0.0F, 1e6F) : 0.0F; }

}  // namespace

// The formula of https://github.com/KhronosGroup/ToneMapping/tree/main/PBR_Neutral.
Float3 tone_map(Float3 radiance) {
  constexpr float kF90 = 0.04F;
  constexpr float kStart = 0.8F - kF90;
  constexpr float kDesaturation = 0.15F;
  Float3 c{sane(radiance[0]), sane(radiance[1]), sane(radiance[2])};
  const float least = std::min({c[0], c[1], c[2]});
  const float offset = least < 0.08F ? least - 6.25F * least * least : kF90;
  for (float& part : c) part -= offset;
  const float peak = std::max({c[0], c[1], c[2]});
  if (peak < kStart) return c;
  const float room = 1.0F - kStart;
  const float new_peak = 1.0F - room * room / (peak + room - kStart);
  const float white = 1.0F - 1.0F / (kDesaturation * (peak - new_peak) + 1.0F);
  for (float& part : c) part = part * new_peak / peak * (1.0F - white) + new_peak * white;
  return c;
}

double shown_luminance(double y) {
  const auto grey = static_cast<float>(y);
  return static_cast<double>(srgb_encode(tone_map({grey, grey, grey})[0]));
}

float srgb_encode(float linear) {
  if (linear <= 0.0031308F) return 12.92F * linear;
  return 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

float srgb_decode(float encoded) {
  if (encoded <= 0.04045F) return encoded / 12.92F;
  return std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
}

}  // namespace gltfx::render
