// SPDX-License-Identifier: Apache-2.0
/// The pose of characters that nobody asked to move.
#pragma once

#include <cstdint>
#include <optional>

#include "model/asset.hpp"
#include "model/views.hpp"

namespace gltfx {

/// The animation whose first moment shows skinned meshes in place of their bind pose, in which
/// characters stretch out their arms: the first that moves joints and has "idle" in its name, in
/// any case; else the first that moves joints. Nothing without skins or such an animation.
std::optional<std::uint32_t> find_pose(const model::Asset& asset, const model::Views& views);

}  // namespace gltfx
