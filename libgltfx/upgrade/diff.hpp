// SPDX-License-Identifier: Apache-2.0
/// Edits as a unified diff.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "json/edit.hpp"

namespace gltfx::upgrade {

/// What `edits` (as for json::apply_edits()) do to `text`, with three lines of context, as patch
/// and git read it. `name` stands in the header as it is. Empty when there are no edits.
std::string unified_diff(std::string_view text, std::span<const json::Edit> edits,
                         std::string_view name);

}  // namespace gltfx::upgrade
