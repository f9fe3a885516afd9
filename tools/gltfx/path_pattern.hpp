// SPDX-License-Identifier: Apache-2.0
/// Patterns of paths in configurations.
#pragma once

#include <string_view>

namespace gltfx::tool {

/// Whether `pattern` matches `path` ('/' separated, without "." and ".."). '*', '?' and '[...]'
/// match within a name, "**" matches any number of folders; a pattern that ends in '/' matches
/// everything below. A pattern without another '/' matches a name at any depth.
bool fits_pattern(std::string_view pattern, std::string_view path);

}  // namespace gltfx::tool
