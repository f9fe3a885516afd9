// SPDX-License-Identifier: Apache-2.0
/// Letters for what stands below small pictures.
#pragma once

#include <cstdint>
#include <string_view>

#include "preview/picture.hpp"

namespace gltfx::preview {

constexpr std::uint32_t kLabelHeight = 18;  ///< pixels from the highest to the lowest letter

/// Writes a line of UTF-8 into a picture of 8-bit RGB, in the middle of `width` pixels from `left`
/// on. What is too long ends with three dots; what is not known is a box. The place has to lie in
/// the picture.
void write_label(Picture& picture, std::string_view text, std::uint32_t left, std::uint32_t top,
                 std::uint32_t width);

}  // namespace gltfx::preview
