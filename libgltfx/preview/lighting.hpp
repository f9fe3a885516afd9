// SPDX-License-Identifier: Apache-2.0
/// The lighting of a picture, and the studio for assets without lights.
#pragma once

#include <gltfx/vec3.hpp>

#include <optional>

#include "preview/framing.hpp"
#include "render/bvh.hpp"
#include "render/scene.hpp"
#include "render/view.hpp"
#include "render/world.hpp"

namespace gltfx::preview {

/// Soft boxes around a bright room: a key light from the upper left of a camera that looks along
/// -`backward`, a fill from the right, a rim light from behind. White surfaces are drawn a little
/// below white. `modelling`: with less light from the right, so that the sides of a cube without
/// color or gloss differ.
render::EnvironmentImage studio_environment(const Vec3d& backward, bool modelling = false);

/// The unoccluded irradiance of a surface: the integral of the radiance of the environment times
/// the cosine to the normal.
Rgb irradiance(const render::EnvironmentImage& image, const Vec3d& normal);

/// Whether everything drawn has the default material: white, rough metal.
bool is_plain(const render::Scene& scene);

enum class Lamps : std::uint8_t { studio, asset, both };

struct LightingOptions {
  Lamps lamps = Lamps::both;
  /// Nothing: the environment of the scene, else the studio's backdrop.
  std::optional<render::Background> background;
  double exposure = 0;        ///< stops
  double rotation = 0;        ///< of environment or studio around y; degrees, as Direction counts
  bool dim_backdrop = false;  ///< darker, so that objects as bright as the usual backdrop stand out
  /// The camera is in a closed room, where all emissive surfaces count as lamps.
  bool enclosed = false;
};

/// An environment of the scene replaces studio and backdrop. Otherwise the studio follows the
/// camera; lamps of the asset are added, dimmed to its brightness if they exceed it, or used alone,
/// scaled to that brightness: the candela of assets vary widely.
render::World make_world(const render::Scene& scene, const Subject& subject,
                         const render::View& view, const LightingOptions& options);

/// The eye of a picture; nothing for a camera in a closed room, where no wall turns its back to it:
/// then light comes in through all walls.
std::optional<render::Eye> eye_of(const render::View& view, const render::Bvh& bvh);

}  // namespace gltfx::preview
