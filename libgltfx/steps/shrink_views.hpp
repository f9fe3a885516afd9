// SPDX-License-Identifier: Apache-2.0
/// Shrinks buffer views that lost some of their accessors.
#pragma once

#include <cstdint>
#include <set>

#include "json/edit.hpp"
#include "steps/geometry_input.hpp"
#include "steps/new_buffer.hpp"

namespace gltfx::steps {

/// Removes the bytes of `gone` accessors from views that also have other accessors. The remaining
/// bytes move by multiples of 8. Views that have other users, or whose index may occur in an
/// extension without a schema, do not change.
void shrink_views(const GeometryInput& input, const std::set<std::uint32_t>& gone,
                  NewBuffer& buffer, json::Editor& editor);

}  // namespace gltfx::steps
