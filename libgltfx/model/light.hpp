// SPDX-License-Identifier: Apache-2.0
/// Lights without extent (KHR_lights_punctual), and environment light (EXT_lights_image_based).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "model/node.hpp"
#include "model/properties.hpp"

namespace gltfx::model {

enum class LightType : std::uint8_t { directional, point, spot };

/// One light; it shines along -Z of its node.
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

/// The light of a node, as an index into read_lights(), or nothing.
std::optional<std::uint32_t> light_of(const Asset& asset, const Node& node);

/// Coefficients of spherical harmonics up to l = 2, ordered by l, then by m from -l to l; of R, G
/// and B.
using Harmonics = std::array<std::array<float, 3>, 9>;

/// Light from all directions, the same everywhere.
struct EnvironmentLight {
  Quaternion rotation{0, 0, 0, 1};
  float intensity = 1;     ///< factor on the images and on the irradiance
  Harmonics irradiance{};  ///< by the normal of a surface
  /// Images of the sharpest cube map, as seen from its center: +X, -X, +Y, -Y, +Z, -Z.
  std::array<std::uint32_t, 6> faces{};
};

/// The environment light of a scene, or nothing if it has none or a malformed one.
std::optional<EnvironmentLight> environment_light_of(const Asset& asset, std::uint32_t scene,
                                                     const AnimatedValues* animated = nullptr);

}  // namespace gltfx::model
