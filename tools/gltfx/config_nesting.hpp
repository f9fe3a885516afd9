// SPDX-License-Identifier: Apache-2.0
/// What toml++ does not survive, found before it parses: it recurses on tables and arrays in one
/// another, and some characters beyond ASCII are undefined behaviour outside of strings.
#pragma once

#include <cstdint>
#include <string_view>

namespace gltfx::tool {

struct ConfigObstacle {
  std::uint32_t line = 0;  ///< 0: there is none
  std::string_view problem;
};

/// Brackets that are nested in more than 16 others, a key of more than 17 parts, or a character
/// beyond ASCII outside of strings and comments. Behind an error that every parser stops at it does
/// not look.
ConfigObstacle find_obstacle(std::string_view text);

}  // namespace gltfx::tool
