// SPDX-License-Identifier: Apache-2.0
/// Triangles that lie in one place.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/scene.hpp"

namespace gltfx::bake {

/// Numbers of the triangles that repeat an earlier one, corner for corner, in ascending order. A
/// hierarchy cannot separate them, so that each ray would test them all. Empty where a sample of
/// some thousand triangles has no repeats.
std::vector<std::uint32_t> find_repeats(std::span<const std::array<std::uint32_t, 3>> triangles,
                                        std::span<const Float3> points);

}  // namespace gltfx::bake
