// SPDX-License-Identifier: Apache-2.0
/// Wildcards that the shell did not expand: '*', '?', '[...]' within a name, '**' over folders.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gltfx::tool {

/// Whether `path` has a wildcard in it.
bool is_glob(std::string_view path);

/// Existing paths that match, sorted by bytes. A wildcard does not match a leading dot, and '**'
/// does not step into folders that are symbolic links or whose name begins with a dot.
std::vector<std::string> expand_glob(const std::string& pattern);

}  // namespace gltfx::tool
