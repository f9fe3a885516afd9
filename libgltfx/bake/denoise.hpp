// SPDX-License-Identifier: Apache-2.0
/// Taking the noise out of a picture of few samples.
///
/// Each pixel becomes what a plane through its neighbours says: a regression of first order on
/// position, normal and depth, in which neighbours count by how alike small patches around them are
/// (non-local means), judged on the other half of the samples. After B. Bitterli et al.,
/// Nonlinearly Weighted First-order Regression for Denoising Monte Carlo Renderings (EGSR 2016).
#pragma once

#include "bake/denoise_layers.hpp"
#include "bake/framebuffer.hpp"

namespace gltfx::bake {

/// Pixels beyond a tile's own that it depends on: how far neighbours are looked for, half the width
/// of the patches that are compared, and what their variance depends on.
constexpr int kNeighbours = 4;
constexpr int kPatch = 1;
constexpr std::uint32_t kDenoiseReach = kNeighbours + kPatch + kVarianceReach;

/// Replaces the radiance of rows of the buffer, as resolve() gives it, by the same without noise.
/// The film holds the rows and kDenoiseReach more on either side, as far as the picture has them.
/// Deterministic: the same numbers on any number of threads. A film with fewer than two samples a
/// pixel, or without noise, comes out as it is.
void denoise(const Film& film, const Rows& rows, const DepthRange& depths, unsigned jobs,
             Framebuffer& buffer);

}  // namespace gltfx::bake
