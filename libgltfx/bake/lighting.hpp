// SPDX-License-Identifier: Apache-2.0
/// The lighting of a picture, and what an object without its own stands in.
#pragma once

#include <gltfx/vec3.hpp>

#include <optional>

#include "bake/bvh.hpp"
#include "bake/framing.hpp"
#include "bake/scene.hpp"
#include "bake/view.hpp"
#include "bake/world.hpp"

namespace gltfx::bake {

/// Soft boxes around a bright room: a key light from the upper left of a camera that looks along
/// -`backward`, a fill from the right, a rim light from behind. White surfaces come out a little
/// below white. `modelling`: with less light from the right, so that the sides of a cube differ
/// that has neither color nor gloss.
EnvironmentImage studio_environment(const Vec3d& backward, bool modelling = false);

/// The unoccluded irradiance of a surface: the integral of the radiance of the environment times
/// the cosine to the normal.
Rgb irradiance(const EnvironmentImage& image, const Vec3d& normal);

/// Whether all that is drawn shows the default material alone: white, rough metal.
bool is_plain(const Scene& scene);

enum class Lamps : std::uint8_t { studio, asset, both };

struct LightingOptions {
  Lamps lamps = Lamps::both;
  bool transparent = false;
  double exposure = 0;        ///< stops
  bool dim_backdrop = false;  ///< darker, so that what is as bright as the usual one stands out
  /// The camera stands in a closed room, where all that shines is a lamp.
  bool enclosed = false;
};

/// An environment of the scene's own takes the place of studio and backdrop. Otherwise the studio
/// follows the camera; lamps of the asset shine beside it, dimmed to its brightness where they
/// would drown it, or alone, brought to that brightness: assets mean very different things by one
/// candela.
World make_world(const Scene& scene, const Subject& subject, const View& view,
                 const LightingOptions& options);

/// The eye of a picture; nothing for a camera that stands in a closed room, where no wall turns its
/// back to it: then light comes in through all walls.
std::optional<Eye> eye_of(const View& view, const Bvh& bvh);

}  // namespace gltfx::bake
