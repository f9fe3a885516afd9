// SPDX-License-Identifier: Apache-2.0
/// Pictures of the light all around.
#pragma once

#include <string>

#include "base/result.hpp"
#include "render/scene.hpp"

namespace gltfx {

/// Reads an equirectangular Radiance (.hdr) or OpenEXR (.exr) file, decoded by a worker process.
/// Numbers that are not finite or negative count as 0. What is wider than 4096 texels is made
/// smaller.
Result<render::EnvironmentImage> read_environment(const std::string& path);

}  // namespace gltfx
