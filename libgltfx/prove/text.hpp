// SPDX-License-Identifier: Apache-2.0
/// Checks that edits are the only changes of a text.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "json/edit.hpp"

namespace gltfx::prove {

/// The first byte of `before` that is missing in `after` or not at its place after the edits;
/// nothing if `after` is `before` with exactly these edits. Accepts any edits: if they are not in
/// order or exceed the text, that is a change. Linear; copies nothing.
std::optional<std::size_t> find_unedited_change(std::string_view before, std::string_view after,
                                                std::span<const json::Edit> edits);

}  // namespace gltfx::prove
