// SPDX-License-Identifier: Apache-2.0
/// The source line of a finding, with carets below the marked part.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <cstddef>
#include <string>
#include <string_view>

#include "report/wording.hpp"

namespace gltfx::report {

/// Columns of a printable text: 2 for East Asian wide characters and emoji (Unicode Standard Annex
/// 11), 0 for combining marks and variation selectors, else 1. Terminals differ for sequences of
/// code points, such as flags; these are not handled.
std::size_t display_width(std::string_view text);

/// Columns of the gutter that holds the line number, without the bar: at least 1.
std::size_t gutter_width(const Diagnostic& diagnostic);

/// Three lines: a bar, the excerpt, the carets. The carets are below the marked part as printed,
/// after neutralising, in columns of the terminal. Precondition: the finding has a line.
std::string excerpt_lines(const Diagnostic& diagnostic, const Style& style);

}  // namespace gltfx::report
