// SPDX-License-Identifier: Apache-2.0
/// Whether images show the same.
#pragma once

#include <optional>

#include "codec/client.hpp"
#include "prove/differences.hpp"
#include "prove/object_walk.hpp"
#include "prove/side.hpp"

namespace gltfx::prove {

/// Where two images differ most.
struct TexelDifference {
  std::uint32_t x = 0, y = 0;
  double steps = 0;  ///< of 255; of floats the difference
};

/// Of decoded images with pixels. Grey counts as three equal channels, no alpha as opaque; nothing
/// where all texels are the same. Precondition: of one size, both with floats or neither.
std::optional<TexelDifference> compare_texels(const codec::Image& ours, const codec::Image& theirs);

/// `pair`: objects of images. Not for ImageComparison::none.
void compare_images(const Side& before, const Side& after, const Pair& pair,
                    ImageComparison comparison, Differences& found);

}  // namespace gltfx::prove
