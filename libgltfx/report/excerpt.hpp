// SPDX-License-Identifier: Apache-2.0
/// The source line under a finding, with carets below what is meant.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <string>

#include "report/style.hpp"

namespace gltfx::report {

/// Columns of the gutter that holds the line number, without the bar: at least 1.
std::size_t gutter_width(const Diagnostic& diagnostic);

/// Three lines: a bar, the excerpt, the carets. They stand below what they mark as it is printed,
/// after neutralising and in columns of the terminal. Precondition: the finding has a line.
std::string excerpt_lines(const Diagnostic& diagnostic, const Style& style);

}  // namespace gltfx::report
