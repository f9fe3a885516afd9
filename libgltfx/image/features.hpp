// SPDX-License-Identifier: Apache-2.0
/// Features of image files that engines are measured by (schema/targets/features.json).
#pragma once

#include <string_view>
#include <vector>

#include "image/header.hpp"

namespace gltfx::image {

/// The names of those that a PNG or JPEG file has. Static storage.
std::vector<std::string_view> features_of(const Header& header);

}  // namespace gltfx::image
