// SPDX-License-Identifier: Apache-2.0
/// The text of gltfx inspect.
#pragma once

#include <gltfx/inspect.hpp>

#include <cstddef>
#include <string>

#include "terminal.hpp"

namespace gltfx::tool {

/// All facts about one asset. `most`: rows of each table, the largest first; 0: all, by index.
/// Neutralised; ends in a line break.
std::string inspect_text(const InspectReport& report, std::size_t most, const Style& style);

}  // namespace gltfx::tool
