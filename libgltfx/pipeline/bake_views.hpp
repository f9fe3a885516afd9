// SPDX-License-Identifier: Apache-2.0
/// Where the cameras of the pictures of a scene are.
#pragma once

#include <gltfx/bake.hpp>

#include <string>
#include <vector>

#include "base/result.hpp"
#include "pipeline/bake_scene.hpp"
#include "render/view.hpp"

namespace gltfx {

/// The view in another scene, whose origin may differ.
render::View moved(render::View view, const Vec3d& from_origin, const Vec3d& to_origin);

/// A camera that the options name.
struct NamedCamera {
  std::string word;       ///< "": the usual one
  std::string file_part;  ///< of the names of its pictures; may be empty
};
/// With `if_present` without those that the asset lacks, which are noted where it has others. The
/// usual one if there are none. Precondition: the scene is ready.
std::vector<NamedCamera> named_cameras(const BakeScene& loaded, const BakeOptions& options,
                                       std::vector<std::string>& notes);

/// The views of one of the cameras that the options may name, "" for the usual one: one, or all of
/// a turntable. An Error when there is no such camera, or it cannot do what is asked for.
/// Precondition: the scene is ready.
Result<std::vector<render::View>> choose_views(const BakeScene& loaded, const BakeOptions& options,
                                               double aspect, const std::string& camera = {});

}  // namespace gltfx
