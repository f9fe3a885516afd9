// SPDX-License-Identifier: Apache-2.0
/// One picture of a scene.
#pragma once

#include <gltfx/bake.hpp>

#include <functional>
#include <vector>

#include "bake/film.hpp"
#include "bake/view.hpp"
#include "pipeline/bake_scene.hpp"

namespace gltfx {

struct DrawnPicture {
  bake::Film film;
  std::vector<Rgb> radiance;  ///< by pixel, denoised where asked for
};

/// Precondition: the scene is ready. `progress` may be empty.
DrawnPicture draw_picture(const BakeScene& loaded, const bake::View& view, const BakeSize& size,
                          const BakeOptions& options, std::function<void(double)> progress);

}  // namespace gltfx
