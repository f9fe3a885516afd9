// SPDX-License-Identifier: Apache-2.0
/// Patterns that choose paths, as configurations have them.
#pragma once

#include <string_view>

namespace gltfx::tool {

/// Whether `pattern` fits `path` ('/' separated, without "." and ".."). '*', '?' and '[...]' stay
/// within a name, "**" stands for any number of folders; a pattern that ends in '/' fits what lies
/// below. One without another '/' fits a name at any depth.
bool fits_pattern(std::string_view pattern, std::string_view path);

}  // namespace gltfx::tool
