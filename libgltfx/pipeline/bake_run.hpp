// SPDX-License-Identifier: Apache-2.0
/// From a scene to all its pictures.
#pragma once

#include <gltfx/bake.hpp>

#include <map>
#include <string>

#include "pipeline/bake_scene.hpp"

namespace gltfx {

/// PNG files by what their names have before the ending.
using Pictures = std::map<std::string, std::string>;

/// Draws sizes, cameras and frames, with their layers. `kept` gets them where it is not null, else
/// the options say where they are written.
BakeReport run_bake(BakeScene loaded, const BakeOptions& options, Pictures* kept = nullptr);

}  // namespace gltfx
