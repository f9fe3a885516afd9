// SPDX-License-Identifier: Apache-2.0
/// @file
/// The version of gltfx.
#pragma once

#include <string_view>

namespace gltfx {

/// "major.minor.patch" (semver.org) of the library that was linked. Static storage.
std::string_view version();

}  // namespace gltfx
