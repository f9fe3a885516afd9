// SPDX-License-Identifier: Apache-2.0
/// Buffer views that some of their accessors left.
#pragma once

#include <cstdint>
#include <set>

#include "json/edit.hpp"
#include "steps/geometry_input.hpp"
#include "steps/new_buffer.hpp"

namespace gltfx::steps {

/// Gives views of which only some accessors are `gone` the bytes of those that stay, which move
/// there by a multiple of 8 bytes. Views with other users, or that an extension without a schema
/// may mean, stay as they are.
void shrink_views(const GeometryInput& input, const std::set<std::uint32_t>& gone,
                  NewBuffer& buffer, json::Editor& editor);

}  // namespace gltfx::steps
