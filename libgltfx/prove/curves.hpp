// SPDX-License-Identifier: Apache-2.0
/// Compares the motion of animation channels, independent of their keyframes.
#pragma once

#include <string>

#include "prove/differences.hpp"
#include "prove/side.hpp"

namespace gltfx::prove {

/// What a channel moves and how, by the numbers of the accessors.
std::string curve_key(const Side& side, json::NodeId channel);

/// `pair`: objects of channels. See AnimationComparison::curves.
void compare_curves(const Side& before, const Side& after, const Pair& pair,
                    const Tolerance& tolerance, Differences& found);

}  // namespace gltfx::prove
