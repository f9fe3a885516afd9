// SPDX-License-Identifier: Apache-2.0
/// Tone mapping and sRGB.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/scene.hpp"

namespace gltfx::render {

/// Khronos PBR Neutral: base colours under a white light do not change, brighter colours are
/// compressed towards white. Linear Rec. 709 in and out; negative and non-finite input counts as 0.
Float3 tone_map(Float3 radiance);

/// A luminance in the tone mapped picture, from 0 to 1.
double shown_luminance(double y);

/// The sRGB transfer function (IEC 61966-2-1) of a number from 0 to 1, and its inverse.
float srgb_encode(float linear);
float srgb_decode(float encoded);
/// The inverse for a byte over 255.
inline constexpr std::array<float, 256> kSrgbBytes = [] {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double encoded = static_cast<double>(i) / 255;
    const double x = (encoded + 0.055) / 1.055;
    double root = 1;  // the fifth one, by Newton's method
    for (int step = 0; step < 40; ++step) {
      root -= (root - x / (root * root * root * root)) / 5;
    }
    table[i] = static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : x * x * root * root);
  }
  return table;
}();
inline float srgb_decode_byte(std::uint8_t encoded) { return kSrgbBytes[encoded]; }

/// Rounds a number from 0 to 1 to 0 to 255.
std::uint8_t to_byte(float value);

}  // namespace gltfx::render
