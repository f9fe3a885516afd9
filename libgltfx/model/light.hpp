// SPDX-License-Identifier: Apache-2.0
/// Lights without extent: KHR_lights_punctual.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/properties.hpp"

namespace gltfx::model {

enum class LightType : std::uint8_t { directional, point, spot };

/// One light; shines along -Z of the node it is on.
struct Light {
  std::string name;
  LightType type = LightType::point;
  std::array<float, 3> color{1, 1, 1};                   ///< linear
  float intensity = 1;                                   ///< candela; lux of a directional light
  float range = std::numeric_limits<float>::infinity();  ///< metres
  float inner_cone_angle = 0;                            ///< radians from the axis, of a spot light
  float outer_cone_angle = 0.78539816F;                  ///< likewise
};

/// All lights of the document by index; nothing for one that is malformed or of another type.
std::vector<std::optional<Light>> read_lights(const Asset& asset,
                                              const AnimatedValues* animated = nullptr);

/// The light that a node carries, as an index into those, or nothing.
std::optional<std::uint32_t> light_of(const Asset& asset, const Node& node);

/// The extension of lights that the document has and that are not read (those by images), or
/// nothing.
std::string_view unread_lights(const Asset& asset);

}  // namespace gltfx::model
