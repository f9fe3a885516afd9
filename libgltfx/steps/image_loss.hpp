// SPDX-License-Identifier: Apache-2.0
/// How far an image is from what it was made of.
#pragma once

#include <optional>

#include "codec/client.hpp"

namespace gltfx::steps {

/// Over all texels and channels, in steps of 8 bits. An alpha that one image lacks counts as
/// opaque.
struct ImageDistance {
  double greatest = 0;
  double mean_square = 0;

  /// The ratio of the greatest value to the error; infinite where there is none.
  double decibels() const;
};

/// Nothing where the sizes differ, or one has floats. Precondition: both have pixels.
std::optional<ImageDistance> distance(const codec::Image& one, const codec::Image& other);

/// Decodes what a request for a new file began with, resized likewise, and the file, and compares.
/// Nothing where one of them is not decoded.
std::optional<ImageDistance> distance(const codec::TranscodeRequest& request,
                                      const codec::EncodedImage& file);

}  // namespace gltfx::steps
