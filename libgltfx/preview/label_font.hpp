// SPDX-License-Identifier: Apache-2.0
/// Text of labels below small pictures.
#pragma once

#include <cstdint>
#include <string_view>

#include "preview/picture.hpp"

namespace gltfx::preview {

constexpr std::uint32_t kLabelHeight = 18;  ///< pixels from the highest to the lowest letter

/// Writes a line of UTF-8 into a picture of 8-bit RGB, in the middle of `width` pixels from `left`
/// on. Long text ends with three dots; unknown characters are boxes. Precondition: the label is
/// inside the picture.
void write_label(Picture& picture, std::string_view text, std::uint32_t left, std::uint32_t top,
                 std::uint32_t width);

}  // namespace gltfx::preview
