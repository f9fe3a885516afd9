// SPDX-License-Identifier: Apache-2.0
/// Texts as C++ source.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "schema/compile.hpp"

namespace gltfx::schema {

/// The text as ordinary string literals of at most 100 characters per line; non-ASCII bytes in
/// octal.
std::string cpp_literal(std::string_view text);

/// A schema file without the whitespace between its tokens.
std::string minified(const std::string& json);

/// A C++ file with the definitions for schema/embedded.hpp: these files, and the image of their
/// Set. Compilers accept literals of at most 64 KiB.
std::string embed(const std::vector<SourceFile>& files, const std::string& image);

/// The header base/material_table.hpp: rows of base/material_row.hpp for the core, for extensions
/// that have a successor, and for the others, each in the order of the set. If several texts name
/// one parameter, the newer text comes later.
std::string material_table(const Set& set);

}  // namespace gltfx::schema
