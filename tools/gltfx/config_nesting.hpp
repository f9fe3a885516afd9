// SPDX-License-Identifier: Apache-2.0
/// How deep a TOML text nests, before it is parsed: toml++ recurses on tables and arrays in one
/// another, also when it frees them.
#pragma once

#include <cstdint>
#include <string_view>

namespace gltfx::tool {

/// The line where brackets are nested in more than 16 others, or a key has more than 17 parts; 0
/// when there is none. Behind a fault that every parser stops at it does not look.
std::uint32_t line_of_deep_nesting(std::string_view text);

}  // namespace gltfx::tool
