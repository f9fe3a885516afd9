// SPDX-License-Identifier: Apache-2.0
/// Texts as C++ source.
#pragma once

#include <string>
#include <vector>

#include "schema/compile.hpp"

namespace gltfx::schema {

/// A C++ file that defines `embedded_files()` (schema/embedded.hpp) with these files, whitespace
/// between tokens taken out. Literals are split below what compilers take (64 KiB).
std::string embed(const std::vector<SourceFile>& files);

}  // namespace gltfx::schema
