// SPDX-License-Identifier: Apache-2.0
/// Phase 7: whether images are what the slots that show them read. Headers first; pixels as far as
/// they were asked for.
#pragma once

#include <gltfx/report.hpp>

#include <span>
#include <vector>

#include "validate/rules/pixel_source.hpp"
#include "validate/rules/texture_slots.hpp"

namespace gltfx::validate {

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

/// All of them. The images that are decoded for it are counted in `report`.
void check_texture_slots(const Context& context, const model::ResourceData& resources, Sink& sink,
                         FileReport& report);

}  // namespace gltfx::validate
