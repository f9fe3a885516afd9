// SPDX-License-Identifier: Apache-2.0
/// Texts as C++ source.
#pragma once

#include <string>
#include <vector>

#include "schema/compile.hpp"

namespace gltfx::schema {

/// A C++ file that defines what schema/embedded.hpp declares: these files, whitespace between
/// tokens taken out, and the image of their Set. Literals are split below what compilers take (64
/// KiB).
std::string embed(const std::vector<SourceFile>& files, const std::string& image);

}  // namespace gltfx::schema
