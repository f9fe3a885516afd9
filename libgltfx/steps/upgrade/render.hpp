// SPDX-License-Identifier: Apache-2.0
/// New images from the pixels of old ones.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "codec/client.hpp"
#include "steps/upgrade/image_cache.hpp"
#include "steps/upgrade/image_job.hpp"
#include "steps/upgrade/pictures.hpp"

namespace gltfx::upgrade {

/// Texels with their memory.
struct Texels {
  codec::Raster raster;
  std::vector<std::byte> bytes;
};

/// Applies a recipe to all texels. Precondition: at least one channel has an image as its source,
/// and all images have the same size.
Texels mix(const Recipe& recipe);

/// The file of a new image: a PNG, always the same for the same job and images. An Error if an
/// image cannot be read, sizes differ or the encoder fails. `origin` is that of the images.
Result<std::shared_ptr<const std::string>> render(const ImageJob& job, Pictures& pictures,
                                                  ImageCache& cache, const Origin& origin);

}  // namespace gltfx::upgrade
