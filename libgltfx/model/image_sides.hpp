// SPDX-License-Identifier: Apache-2.0
/// Sizes of images, as the unit of texture coordinates.
#pragma once

#include "model/resource_data.hpp"

namespace gltfx::model {

/// The longest side of any image in texels, by its header; 1024 without images. An image that
/// cannot be read counts as 4096.
double longest_image_side(const ResourceData& resources);

}  // namespace gltfx::model
