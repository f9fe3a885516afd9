// SPDX-License-Identifier: Apache-2.0
/// The choice of a tone curve.
#pragma once

#include <cstdint>

#include "render/scene.hpp"

namespace gltfx::render {

/// How radiance becomes the range of a display.
enum class ToneCurve : std::uint8_t {
  neutral,  ///< tone_map() in tonemap.hpp
  /// The fit of the ACES reference rendering and output transforms by Stephen Hill, with the
  /// exposure 1/0.6 of three.js' ACESFilmicToneMapping.
  aces,
  /// AgX by Troy Sobotka, in Rec. 2020 as Blender and Filament have it, with the polynomial for its
  /// sigmoid by Benjamin Wrensch; its base look.
  agx,
  none,  ///< clipped at 1
};

/// Linear Rec. 709 in and out, the result from 0 to 1; negative and non-finite input counts as 0.
Float3 tone_map(const Float3& radiance, ToneCurve curve);

}  // namespace gltfx::render
