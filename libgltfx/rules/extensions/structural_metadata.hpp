// SPDX-License-Identifier: Apache-2.0
/// Attributes of meshes that metadata needs.
#pragma once

#include <cstdint>
#include <functional>

#include "rules/context.hpp"

namespace gltfx::validate {

/// Calls `use` with the n of each TEXCOORD_n by which feature IDs of a primitive are read. True: it
/// has property textures, which may read any of them.
bool visit_data_texcoords(const Context& context, json::NodeId primitive,
                          const std::function<void(std::uint64_t)>& use);

}  // namespace gltfx::validate
