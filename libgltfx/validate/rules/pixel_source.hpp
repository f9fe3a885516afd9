// SPDX-License-Identifier: Apache-2.0
/// Decoded images, as far as they are asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "codec/client.hpp"
#include "model/resource_data.hpp"

namespace gltfx::validate {

/// What decoding told of the images of one asset. Nothing is decoded that nobody asked for. The
/// resources must outlive it.
class PixelSource {
 public:
  /// `texels` is how many may be decoded, all images together.
  explicit PixelSource(const model::ResourceData& resources,
                       std::uint64_t texels = std::uint64_t{1} << 30U)
      : resources_(resources), texels_left_(texels), results_(resources.images.size()) {}

  struct Request {
    std::uint32_t image = 0;
    bool normals = false;  ///< look at it as at a normal map
  };
  /// Decodes images that have a sound header, `jobs` at a time; others are left out, and what there
  /// are no texels left for fails as too large. Stops where images run into limits of time and
  /// memory.
  void decode(const std::vector<Request>& wanted, unsigned jobs);

  /// What was found, or null where nothing was decoded.
  const codec::Image* of(std::uint32_t image) const {
    return results_[image] ? std::get_if<codec::Image>(&*results_[image]) : nullptr;
  }
  /// Why an image that was asked for could not be decoded, or null.
  const codec::DecodeError* error(std::uint32_t image) const {
    return results_[image] ? std::get_if<codec::DecodeError>(&*results_[image]) : nullptr;
  }

 private:
  /// Takes the texels of an image from what may be decoded.
  bool take(std::uint32_t index);
  codec::ImageResult decoded(const Request& request) const;

  const model::ResourceData& resources_;
  std::uint64_t texels_left_;
  std::vector<std::optional<codec::ImageResult>> results_;
};

}  // namespace gltfx::validate
