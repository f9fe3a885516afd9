// SPDX-License-Identifier: Apache-2.0
/// Pictures of the light all around.
#pragma once

#include <memory>
#include <string>

#include "base/result.hpp"
#include "render/scene.hpp"

namespace gltfx {

/// Reads an equirectangular image, decoded by a worker process: Radiance (.hdr), OpenEXR (.exr), an
/// image format of glTF, or one that OpenImageIO decodes, if that is installed. Floats are linear
/// light, integers sRGB. Numbers that are not finite or negative count as 0. Images wider than 4096
/// texels are reduced. The last one is kept, for all pictures that have it.
Result<std::shared_ptr<const render::EnvironmentImage>> read_environment(const std::string& path);

}  // namespace gltfx
