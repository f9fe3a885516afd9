// SPDX-License-Identifier: Apache-2.0
/// Whether a text changed in its edits alone.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "json/edit.hpp"

namespace gltfx::prove {

/// The first byte of `before` that stands elsewhere in `after` than the edits leave it, or is not
/// there; nothing where `after` is `before` with exactly these edits. Takes any edits: those out of
/// order, or beyond the text, are a change. Linear; copies nothing.
std::optional<std::size_t> find_unedited_change(std::string_view before, std::string_view after,
                                                std::span<const json::Edit> edits);

}  // namespace gltfx::prove
