// SPDX-License-Identifier: Apache-2.0
/// Several changes, each of the asset that the previous one makes, as one change.
#pragma once

#include <string_view>

#include "change/apply.hpp"
#include "change/change.hpp"

namespace gltfx::change {

/// Adds `next`, a change of the asset that `all` makes of one with this text. Precondition: both
/// have been placed.
void append(Change& all, const Change& next, std::string_view text);

/// Removes files that the new asset does not refer to, because a later change moved their bytes.
/// Returns the new text if it was parsed. `text`: that of the old asset.
NewText drop_unnamed_files(Change& all, std::string_view text);

}  // namespace gltfx::change
