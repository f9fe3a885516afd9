// SPDX-License-Identifier: Apache-2.0
/// Taking the noise out of a picture of few samples.
///
/// Each pixel becomes what a plane through its neighbours says: a regression of first order on
/// position, normal and depth, in which neighbours count by how alike small patches around them are
/// (non-local means), judged on the other half of the samples. After B. Bitterli et al.,
/// Nonlinearly Weighted First-order Regression for Denoising Monte Carlo Renderings (EGSR 2016).
#pragma once

#include <vector>

#include "bake/film.hpp"

namespace gltfx::bake {

/// Radiance by pixel, as Film::radiance() gives it without the noise. Deterministic: the same film
/// gives the same picture on any number of threads. A film with fewer than two samples a pixel, or
/// without noise, comes out as it is.
std::vector<Rgb> denoise(const Film& film, unsigned jobs);

}  // namespace gltfx::bake
