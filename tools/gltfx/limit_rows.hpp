// SPDX-License-Identifier: Apache-2.0
/// Limits as rows of text.
#pragma once

#include <gltfx/limit.hpp>

#include <string>
#include <string_view>

namespace gltfx::tool {

/// "budgets.mesh.triangles  max 20,000 (warning)  WHY" and a line break, in the columns of `gltfx
/// config`.
std::string limit_row(const Limit& limit, std::string_view why);

/// A name, a value and where it is from, in these columns.
std::string config_row(std::string_view name, std::string_view value, std::string_view why);

}  // namespace gltfx::tool
