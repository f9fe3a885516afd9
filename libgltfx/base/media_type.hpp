// SPDX-License-Identifier: Apache-2.0
/// Media types of assets (IANA).
#pragma once

#include <string_view>

namespace gltfx {

inline constexpr std::string_view kGltfMediaType = "model/gltf+json";
inline constexpr std::string_view kGlbMediaType = "model/gltf-binary";

}  // namespace gltfx
