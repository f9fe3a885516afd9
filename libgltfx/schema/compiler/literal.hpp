// SPDX-License-Identifier: Apache-2.0
/// Texts as C++ source.
#pragma once

#include <string>
#include <string_view>

namespace gltfx::schema {

/// The text as ordinary string literals of at most 100 characters a line; bytes beyond ASCII in
/// octal.
std::string cpp_literal(std::string_view text);

}  // namespace gltfx::schema
