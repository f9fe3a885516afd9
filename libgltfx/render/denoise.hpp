// SPDX-License-Identifier: Apache-2.0
/// Denoising of a picture of few samples, by nonlinearly weighted first-order regression.
///
/// The value of a pixel is that of a plane fitted to its neighbours, over position, normal, depth
/// and albedo. Weights of neighbours are those of non-local means, by the distance of the patches
/// around two pixels, times those of the distance between two normals. After B. Bitterli et al.,
/// Nonlinearly Weighted First-order Regression for Denoising Monte Carlo Renderings (EGSR 2016).
#pragma once

#include "render/denoise_layers.hpp"
#include "render/framebuffer.hpp"

namespace gltfx::render {

/// Pixels around a tile on which it depends: the radius of the search window, that of the patches
/// that are compared, and that of the variance estimate.
constexpr int kNeighbours = 4;
constexpr int kPatch = 1;
constexpr std::uint32_t kDenoiseReach = kNeighbours + kPatch + kVarianceReach;

/// Replaces the radiance of rows of the buffer, as resolve() gives it, by denoised radiance.
/// The film holds the rows and kDenoiseReach more on either side, as far as the picture has them.
/// Deterministic: the same values on any number of threads. A film with fewer than two samples per
/// pixel, or without noise, is not changed.
void denoise(const Film& film, const Rows& rows, const DepthRange& depths, unsigned jobs,
             Framebuffer& buffer);

}  // namespace gltfx::render
