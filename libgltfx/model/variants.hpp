// SPDX-License-Identifier: Apache-2.0
/// Materials that a variant of the asset gives its primitives: KHR_materials_variants.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/asset.hpp"
#include "model/mesh.hpp"

namespace gltfx::model {

/// The names of the variants, by index; empty for one without a name.
std::vector<std::string> variant_names(const Asset& asset);

/// The material of a primitive while `variant` is active: that of a mapping that lists the variant,
/// else its own. Nothing: the default material.
std::optional<std::uint32_t> material_of(const Asset& asset, const Primitive& primitive,
                                         std::optional<std::uint32_t> variant);

}  // namespace gltfx::model
