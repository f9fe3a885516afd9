// SPDX-License-Identifier: Apache-2.0
/// How far rays may go.
#pragma once

#include "bake/ray.hpp"
#include "bake/scene.hpp"

namespace gltfx::bake {

/// Embree ends the program at a ray from beyond 1.8e18.
inline constexpr double kFarthest = 5e17;

/// How much longer rays become on their way into the space of a mesh, in the worst direction;
/// infinite where there is no way, or none in floats.
double inverse_norm(const Matrix34& m);

}  // namespace gltfx::bake
