// SPDX-License-Identifier: Apache-2.0
/// Measures the difference between an image and its source.
#pragma once

#include <optional>

#include "codec/client.hpp"

namespace gltfx::steps {

/// The difference over all texels and channels, in units of 1/255. An image without alpha counts as
/// opaque.
struct ImageDistance {
  double greatest = 0;
  double mean_square = 0;

  /// Peak signal-to-noise ratio; infinite if there is no error.
  double decibels() const;
};

/// Nothing if the sizes differ or an image has floats. Precondition: both have pixels.
std::optional<ImageDistance> distance(const codec::Image& one, const codec::Image& other);

/// Decodes and resizes the source image of a request, decodes the new file, and compares them.
/// Nothing if one of them cannot be decoded.
std::optional<ImageDistance> distance(const codec::TranscodeRequest& request,
                                      const codec::EncodedImage& file);

}  // namespace gltfx::steps
