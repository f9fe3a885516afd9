// SPDX-License-Identifier: Apache-2.0
/// Texts as C++ source.
#pragma once

#include <string>
#include <vector>

#include "schema/compile.hpp"

namespace gltfx::schema {

/// A schema file without the whitespace between its tokens.
std::string minified(const std::string& json);

/// A C++ file that defines what schema/embedded.hpp declares: these files, and the image of their
/// Set. Literals are split below what compilers take (64 KiB).
std::string embed(const std::vector<SourceFile>& files, const std::string& image);

}  // namespace gltfx::schema
