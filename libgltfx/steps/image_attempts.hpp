// SPDX-License-Identifier: Apache-2.0
/// Encodes images in the first way of their plans that succeeds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "codec/client.hpp"
#include "codec/image_distance.hpp"
#include "steps/image_encodings.hpp"
#include "steps/image_plan.hpp"
#include "steps/image_store.hpp"

namespace gltfx::steps {

/// The result for one group of images.
struct Encoded {
  const ImageAttempt* attempt = nullptr;  ///< that succeeded; null: none
  std::string bytes;
  codec::Raster source, raster;
  std::optional<codec::ImageDistance> distance;  ///< for lossy formats
  std::uint64_t gpu_bytes = 0;                   ///< on a graphics card
};

/// One group of images with its plan.
struct Job {
  ImageGroup group;
  ImageFile file;
  ImagePlan plan;
  Encoded encoded;
  std::string trouble;  ///< as in StepOutcome
};

/// The greatest error of a value in units of 1/255 that a lossy format guarantees; 0: no guarantee.
double bound_of(const ImageAttempt& attempt, const codec::Raster& source);

/// Tries the attempts in order. Thread-safe for different jobs.
void encode(Job& job, ImageEncodings& encodings);

}  // namespace gltfx::steps
