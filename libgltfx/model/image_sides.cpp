// SPDX-License-Identifier: Apache-2.0
#include "model/image_sides.hpp"

#include <algorithm>

namespace gltfx::model {

double longest_image_side(const ResourceData& resources) {
  constexpr double kWithoutImages = 1024;
  constexpr double kUnknown = 4096;
  double longest = resources.images.empty() ? kWithoutImages : 1;
  for (const ImageData& image : resources.images) {
    const double side =
        image.header ? static_cast<double>(std::max(image.header->width, image.header->height))
                     : kUnknown;
    longest = std::max(longest, side);
  }
  return longest;
}

}  // namespace gltfx::model
