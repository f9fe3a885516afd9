// SPDX-License-Identifier: Apache-2.0
/// How many columns a text takes in a terminal.
#pragma once

#include <cstddef>
#include <string_view>

namespace gltfx::report {

/// Columns of a printable text: 2 for East Asian wide characters and emoji (Unicode Standard Annex
/// 11), 0 for combining marks and variation selectors, else 1. Terminals disagree about what is
/// drawn from several code points, such as flags; that is not followed.
std::size_t display_width(std::string_view text);

}  // namespace gltfx::report
