// SPDX-License-Identifier: Apache-2.0
/// Phase 7: whether images are suitable for the slots that use them. Headers first; pixels as far
/// as requested.
#pragma once

#include <gltfx/report.hpp>

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <variant>
#include <vector>

#include "codec/client.hpp"
#include "model/image_decoding.hpp"
#include "model/resource_data.hpp"
#include "rules/core/animated.hpp"
#include "rules/payload/texel_study.hpp"
#include "rules/payload/texture_slots.hpp"

namespace gltfx::validate {

/// Results of decoding the images of one asset. Only requested images are decoded. The resources
/// must outlive it.
class PixelSource {
 public:
  /// `texels`: the maximum number of decoded texels, all images together.
  explicit PixelSource(const model::ResourceData& resources,
                       std::uint64_t texels = std::uint64_t{1} << 30U)
      : decoding_(resources, texels) {}

  struct Request {
    std::uint32_t image = 0;
    bool normals = false;  ///< check it as a normal map
    bool slopes = false;   ///< study its slopes
    bool alpha = false;    ///< study its alpha
  };
  /// Decodes images with a valid header, `jobs` at a time; others are skipped, and images beyond
  /// the limit of texels fail as too large. Stops if images reach limits of time and memory.
  void decode(const std::vector<Request>& wanted, unsigned jobs);

  /// The decoded image, or null if it was not decoded.
  const codec::Image* of(std::uint32_t image) const {
    const codec::ImageResult* result = result_of(image);
    return result == nullptr ? nullptr : std::get_if<codec::Image>(result);
  }
  /// The reason why a requested image could not be decoded, or null.
  const codec::DecodeError* error(std::uint32_t image) const {
    const codec::ImageResult* result = result_of(image);
    return result == nullptr ? nullptr : std::get_if<codec::DecodeError>(result);
  }
  /// The studies that were requested of an image, or null: also where it has too few channels.
  const SlopeStudy* slopes(std::uint32_t image) const {
    const auto found = studies_.find(image);
    return found == studies_.end() || !found->second.slopes ? nullptr : &*found->second.slopes;
  }
  const AlphaStudy* alpha(std::uint32_t image) const {
    const auto found = studies_.find(image);
    return found == studies_.end() || !found->second.alpha ? nullptr : &*found->second.alpha;
  }

 private:
  struct Studies {
    std::optional<SlopeStudy> slopes;
    std::optional<AlphaStudy> alpha;
  };
  const codec::ImageResult* result_of(std::uint32_t image) const {
    const auto found = results_.find(image);
    return found == results_.end() ? nullptr : &found->second;
  }

  model::ImageDecoding decoding_;
  std::unordered_map<std::uint32_t, codec::ImageResult> results_;  ///< by image
  std::unordered_map<std::uint32_t, Studies> studies_;             ///< likewise
};

/// What the phase leaves to rules about what an asset shows.
struct StudiedTextures {
  Animated animated;
  std::vector<TextureSlot> slots;
  PixelSource pixels;
};

/// The input of the rules of this phase. They report to `sink`.
struct TexturePhase {
  const Context& context;
  const model::ResourceData& resources;
  Sink& sink;
  const Animated& animated;
  const std::vector<TextureSlot>& slots;
  PixelSource& pixels;

  /// The header of an image, or null if it could not be read or is in doubt.
  const image::Header* header(std::uint32_t image) const {
    const auto& found = resources.images[image].header;
    return found && found->doubt.empty() ? &*found : nullptr;
  }
};

/// Statistics of the channel that a slot reads as 'r', 'g', 'b' or 'a'. Precondition: for 'a' the
/// image has alpha.
const codec::ChannelStatistics& statistics_of(const codec::Image& image, char channel);

/// Channels: missing alpha and colors, textures hidden by a factor of 0, coverage.
void check_channels(const TexturePhase& phase);
/// Several slots with one image: color spaces, texture coordinates.
void check_sharing(const TexturePhase& phase);
/// Requirements on KTX2 images by the slots and samplers that use them.
void check_ktx2_slots(const TexturePhase& phase);
/// Checks that need decoded pixels.
void check_pixels(const TexturePhase& phase);

}  // namespace gltfx::validate
