// SPDX-License-Identifier: Apache-2.0
/// Whether anything of a primitive can be seen.
#pragma once

#include <optional>

#include "model/accessor_data.hpp"
#include "model/mesh.hpp"
#include "rules/payload/phases.hpp"
#include "rules/payload/texture_phase.hpp"

namespace gltfx::validate {

/// Whether a triangle has an area, a line a length, or there is a point. Nothing: the elements
/// cannot be read, or exceed the budget of the phase. Precondition: the primitive has a mode.
std::optional<bool> has_extent(DataPhase& phase, const model::Primitive& primitive,
                               const model::AccessorData& positions);

/// Whether the alpha of material and vertex colors leaves nothing of a primitive, whatever its
/// texture has. With `pixels`, also that of the texture, which is decoded.
bool is_clear(DataPhase& phase, const model::Primitive& primitive, PixelSource* pixels);

}  // namespace gltfx::validate
