// SPDX-License-Identifier: Apache-2.0
/// Edits as a unified diff.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "json/edit.hpp"

namespace gltfx::change {

/// What `edits` (as for json::apply_edits()) do to `text`, with three lines of context, as patch
/// and git read it. `name` is the file's, quoted as git does where it has to be; `mark` stands
/// before every line. Empty when there are no edits.
std::string unified_diff(std::string_view text, std::span<const json::Edit> edits,
                         std::string_view name, std::string_view mark = {});

}  // namespace gltfx::change
