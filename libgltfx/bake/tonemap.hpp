// SPDX-License-Identifier: Apache-2.0
/// From radiance to numbers of a display.
#pragma once

#include <cstdint>

#include "bake/scene.hpp"

namespace gltfx::bake {

/// Khronos PBR Neutral: base colours under a white light come out as they are, what is brighter is
/// compressed towards white. Linear Rec. 709 in and out; negative and non-finite input counts as 0.
Float3 tone_map(Float3 radiance);

/// The sRGB transfer function (IEC 61966-2-1) of a number from 0 to 1, and its inverse.
float srgb_encode(float linear);
float srgb_decode(float encoded);
/// That of byte / 255, from a table.
float srgb_decode_byte(std::uint8_t encoded);

/// Rounds a number from 0 to 1 to 0 to 255.
std::uint8_t to_byte(float value);

}  // namespace gltfx::bake
