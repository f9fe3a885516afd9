// SPDX-License-Identifier: Apache-2.0
#include "rules/payload/texture_phase.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <utility>

#include "base/codes.hpp"
#include "rules/collector.hpp"
#include "rules/payload/phases.hpp"

namespace gltfx::validate {
namespace {

// The images that must be decoded, and for which checks.
class PixelNeeds {
 public:
  PixelNeeds(const Context& context, const model::ResourceData& resources,
             const std::vector<TextureSlot>& slots)
      : context_(context),
        resources_(resources),
        slots_(slots),
        hints_(enabled(Code::TEXTURE_CONSTANT) || enabled(Code::TEXTURE_ALPHA_OPAQUE)),
        normal_maps_(enabled(Code::NORMAL_MAP_NOT_UNIT) || enabled(Code::NORMAL_MAP_INWARD) ||
                     enabled(Code::NORMAL_MAP_FLAT)),
        coverage_(enabled(Code::MATERIAL_ALPHA_MISSING)),
        alpha_(enabled(Code::TEXTURE_ALPHA_CONSTANT)),
        equal_(enabled(Code::TEXTURE_CHANNELS_EQUAL)),
        occlusion_(enabled(Code::OCCLUSION_BLACK)),
        emission_(enabled(Code::EMISSION_HIDES_COLOR)),
        slopes_(enabled(Code::NORMAL_MAP_DIRECTX)),
        colors_(enabled(Code::NORMAL_MAP_AS_COLOR)),
        seen_alpha_(enabled(Code::BLEND_SHOWS_OPAQUE) || enabled(Code::MASK_ALPHA_GRADIENT)) {}

  std::vector<PixelSource::Request> find() {
    const PixelLevel level = pixel_level(context_.options);
    if (level == PixelLevel::headers) return {};
    if (level == PixelLevel::all) {
      for (std::size_t i = 0; i < resources_.images.size(); ++i) {
        request(static_cast<std::uint32_t>(i));
      }
    }
    for (const TextureSlot& slot : slots_) add(slot);
    add_conflicts();
    std::vector<PixelSource::Request> requests;
    for (const auto& [image, request] : requests_) requests.push_back(request);
    return requests;
  }

 private:
  bool enabled(Code code) const { return is_enabled(context_.options, code); }

  PixelSource::Request& request(std::uint32_t image) {
    PixelSource::Request& request = requests_[image];
    request.image = image;
    return request;
  }

  // For rules about what an asset shows.
  void add_shown(const TextureSlot& slot) {
    if (slot.material == json::kNoNode || slot.images.empty() || slot.effective.empty()) return;
    const std::uint32_t image = slot.images.front();
    const auto& header = resources_.images[image].header;
    if (!header) return;
    const bool black = occlusion_ && slot.property == "occlusionTexture";
    const bool white = emission_ && slot.property == "emissiveTexture";
    const bool color = colors_ && (slot.coverage || white) && !header->grey;
    const bool slopes = color || (slopes_ && slot.normal_map && !header->grey);
    const bool alpha = seen_alpha_ && slot.coverage && slot.effective.has('a') &&
                       image::can_be_transparent(*header);
    if (!black && !white && !slopes && !alpha) return;
    PixelSource::Request& wanted = request(image);
    wanted.slopes = wanted.slopes || slopes;
    wanted.alpha = wanted.alpha || alpha;
  }

  void add(const TextureSlot& slot) {
    add_shown(slot);
    const bool normal = slot.normal_map && normal_maps_;
    const bool alpha = slot.effective.has('a') && (slot.coverage ? coverage_ : alpha_);
    // Only pixels distinguish a gray map from a colored one.
    const bool red = slot.property == "diffuseTransmissionTexture" && alpha;
    const bool data = equal_ && !slot.srgb && slot.effective.colors() >= 2;
    for (const std::uint32_t image : slot.images) {
      const auto& header = resources_.images[image].header;
      if (!header) continue;
      const bool transparent = image::can_be_transparent(*header);
      const bool grey = data && !header->grey;
      if (hints_ || normal || red || grey || (alpha && transparent)) request(image);
      if (normal) request(image).normals = true;
    }
  }

  // Images that are read as sRGB and as linear are only invalid if they have values other than 0
  // and 1.
  void add_conflicts() {
    if (!enabled(Code::TEXTURE_COLOR_SPACE_CONFLICT)) return;
    std::map<std::uint32_t, std::array<bool, 2>> read;
    for (const TextureSlot& slot : slots_) {
      if (slot.effective.colors() == 0) continue;
      for (const std::uint32_t image : slot.images) {
        auto& ways = read[image];
        ways[slot.srgb ? 1 : 0] = true;
        if (ways[0] && ways[1]) request(image);
      }
    }
  }

  const Context& context_;
  const model::ResourceData& resources_;
  const std::vector<TextureSlot>& slots_;
  // whether rules that need pixels are enabled
  const bool hints_, normal_maps_, coverage_, alpha_, equal_, occlusion_, emission_, slopes_,
      colors_, seen_alpha_;
  std::map<std::uint32_t, PixelSource::Request> requests_;  // by image
};

}  // namespace

void PixelSource::decode(const std::vector<Request>& wanted, unsigned jobs) {
  std::vector<model::ImageDecoding::Request> requests;
  for (const Request& each : wanted) {
    requests.push_back({each.image, each.normals, each.slopes || each.alpha});
  }
  std::vector<Studies> studies(wanted.size());
  const auto study = [&](std::size_t i, codec::ImageResult& result) {
    if (!requests[i].pixels) return;
    auto& image = std::get<codec::Image>(result);
    if (wanted[i].slopes && image.channels >= 3) studies[i].slopes = study_slopes(image);
    if (wanted[i].alpha && image.has_alpha()) studies[i].alpha = study_alpha(image);
    // Pixels of all images would take too much memory.
    image.pixels = {};
    image.owner.reset();
  };
  decoding_.decode(requests, jobs, study, [&](std::size_t i, codec::ImageResult& result) {
    if (std::holds_alternative<codec::Image>(result)) studies_[wanted[i].image] = studies[i];
    results_[wanted[i].image] = std::move(result);
  });
}

void check_texture_slots(DataPhase& data) {
  const Context& context = data.context;
  const model::ResourceData& resources = data.resources;
  const bool every_image =
      pixel_level(context.options) == PixelLevel::all && !resources.images.empty();
  if (context.checked.slots.empty() && !every_image) return;
  Animated animated(context);
  std::vector<TextureSlot> found = texture_slots(context, animated);
  data.textures = std::make_shared<StudiedTextures>(
      StudiedTextures{std::move(animated), std::move(found), PixelSource(resources)});
  const auto& slots = data.textures->slots;
  PixelSource& pixels = data.textures->pixels;
  const auto wanted = PixelNeeds(context, resources, slots).find();
  pixels.decode(wanted, context.options.jobs);
  data.report.images_wanted += wanted.size();
  data.report.images_decoded += static_cast<std::uint64_t>(std::count_if(
      wanted.begin(), wanted.end(),
      [&](const PixelSource::Request& request) { return pixels.of(request.image) != nullptr; }));
  const TexturePhase phase{context, resources, data.sink, data.textures->animated, slots, pixels};
  check_channels(phase);
  check_sharing(phase);
  check_ktx2_slots(phase);
  check_pixels(phase);
}

}  // namespace gltfx::validate
