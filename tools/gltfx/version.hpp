// SPDX-License-Identifier: Apache-2.0
/// Versions of the program and of its libraries.
#pragma once

#include <string>

namespace gltfx::tool {

/// "gltfx 0.1.0" and one line for each library and the compiler.
std::string version_text();

}  // namespace gltfx::tool
