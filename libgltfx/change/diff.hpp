// SPDX-License-Identifier: Apache-2.0
/// Edits as a unified diff.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "json/edit.hpp"

namespace gltfx::change {

/// The effect of `edits` (as for json::apply_edits()) on `text`, with three lines of context, for
/// patch and git. `name` is that of the file, quoted as in git if needed; `mark` comes before every
/// line. Empty when there are no edits.
std::string unified_diff(std::string_view text, std::span<const json::Edit> edits,
                         std::string_view name, std::string_view mark = {});

}  // namespace gltfx::change
