// SPDX-License-Identifier: Apache-2.0
/// Fixes of images.
#pragma once

#include "rules/fix_entry.hpp"

namespace gltfx::validate {

/// Writes the actual type of an image in place of its declared one.
bool correct_image_type(Fixing& fixing, const Subject& member);

/// Requests that an image is converted.
bool request_conversion(Fixing& fixing, const Subject& image);

}  // namespace gltfx::validate
