// SPDX-License-Identifier: Apache-2.0
/// Phase 7: whether images are what the slots that show them read. Headers first; pixels as far as
/// they were asked for.
#pragma once

#include <gltfx/report.hpp>

#include <cstdint>
#include <unordered_map>
#include <variant>
#include <vector>

#include "codec/client.hpp"
#include "model/resource_data.hpp"
#include "rules/payload/texture_slots.hpp"

namespace gltfx::validate {

/// What decoding told of the images of one asset. Nothing is decoded that nobody asked for. The
/// resources must outlive it.
class PixelSource {
 public:
  /// `texels` is how many may be decoded, all images together.
  explicit PixelSource(const model::ResourceData& resources,
                       std::uint64_t texels = std::uint64_t{1} << 30U)
      : resources_(resources), texels_left_(texels) {}

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
    const codec::ImageResult* result = result_of(image);
    return result == nullptr ? nullptr : std::get_if<codec::Image>(result);
  }
  /// Why an image that was asked for could not be decoded, or null.
  const codec::DecodeError* error(std::uint32_t image) const {
    const codec::ImageResult* result = result_of(image);
    return result == nullptr ? nullptr : std::get_if<codec::DecodeError>(result);
  }

 private:
  /// Takes the texels of an image from what may be decoded.
  bool take(std::uint32_t index);
  codec::ImageResult decoded(const Request& request) const;
  const codec::ImageResult* result_of(std::uint32_t image) const {
    const auto found = results_.find(image);
    return found == results_.end() ? nullptr : &found->second;
  }

  const model::ResourceData& resources_;
  std::uint64_t texels_left_;
  std::unordered_map<std::uint32_t, codec::ImageResult> results_;  ///< by image
};

/// What the rules of this phase are given. They report to `sink`.
struct TexturePhase {
  const Context& context;
  const model::ResourceData& resources;
  Sink& sink;
  const Animated& animated;
  const std::vector<TextureSlot>& slots;
  PixelSource& pixels;

  /// The header of an image, or null where it could not be read or is in doubt.
  const image::Header* header(std::uint32_t image) const {
    const auto& found = resources.images[image].header;
    return found && found->doubt.empty() ? &*found : nullptr;
  }
};

/// Channels: alpha and colours that are not there, textures that a factor of 0 hides, coverage.
void check_channels(const TexturePhase& phase);
/// Several slots that show one image: colour spaces, texture coordinates.
void check_sharing(const TexturePhase& phase);
/// What KTX2 images must be for the slots and samplers that use them.
void check_ktx2_slots(const TexturePhase& phase);
/// What only decoded pixels tell.
void check_pixels(const TexturePhase& phase);

}  // namespace gltfx::validate
