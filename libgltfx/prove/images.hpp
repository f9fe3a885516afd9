// SPDX-License-Identifier: Apache-2.0
/// Compares the contents of images.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "codec/client.hpp"
#include "prove/differences.hpp"
#include "prove/side.hpp"

namespace gltfx::prove {

/// The greatest difference of two images.
struct TexelDifference {
  std::uint32_t x = 0, y = 0;
  double steps = 0;  ///< in steps of 255; for floats the plain difference
};
/// "is 1 of 255 steps away"; `floats`: of images with those.
std::string distance_text(const TexelDifference& difference, bool floats);

/// Compares decoded images with pixels. Grey counts as three equal channels, missing alpha as
/// opaque; nothing if all texels are equal. Precondition: images of the same size, both or neither
/// with floats.
std::optional<TexelDifference> compare_texels(const codec::Image& ours, const codec::Image& theirs);

/// `pair`: objects of images. Not for ImageComparison::none.
void compare_images(const Side& before, const Side& after, const Pair& pair,
                    ImageComparison comparison, Differences& found);

}  // namespace gltfx::prove
