// SPDX-License-Identifier: Apache-2.0
// Slots that share an image: each channel has one meaning, and packed channels have the same
// placement.

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/fields.hpp"
#include "rules/context.hpp"
#include "rules/finding.hpp"
#include "rules/payload/texture_phase.hpp"
#include "rules/payload/texture_slots.hpp"

namespace gltfx::validate {
namespace {

using image::Header;

constexpr std::array kColors{'r', 'g', 'b'};

// --- Color spaces ---

// The first slots that read each color channel of one image, as sRGB and as linear.
struct Readers {
  std::array<const TextureSlot*, 3> srgb{}, linear{};
  bool reported = false;
};

// 0 and 1 are the same in both color spaces.
bool is_two_level(const TexturePhase& phase, std::uint32_t image, std::size_t channel) {
  const Header* header = phase.header(image);
  if (header != nullptr && header->two_level) return true;
  const codec::Image* pixels = phase.pixels.of(image);
  return pixels != nullptr && pixels->binary(pixels->channels < 3 ? 0 : channel);
}

void report_conflict(const TexturePhase& phase, const TextureSlot& slot, const TextureSlot& other,
                     std::uint32_t image, char channel) {
  const ChannelSet shared(std::string_view(&channel, 1));
  report_slot(
      phase.context, phase.sink, slot, Code::TEXTURE_COLOR_SPACE_CONFLICT,
      fmt::format("{} reads {} of {} as {}, but {} reads it as {}.", slot.property, shared.text(),
                  image_label(phase.context, image), slot.srgb ? "sRGB" : "linear",
                  member_label(phase.context, other.use->pointer), slot.srgb ? "linear" : "sRGB"));
}

void check_color_space(const TexturePhase& phase, const TextureSlot& slot, std::uint32_t image,
                       Readers& readers) {
  // A KTX2 image declares one color space, which is checked for each slot.
  if (phase.resources.images[image].ktx2) return;
  for (std::size_t i = 0; i < kColors.size(); ++i) {
    if (!slot.effective.has(kColors[i])) continue;
    const TextureSlot*& own = slot.srgb ? readers.srgb[i] : readers.linear[i];
    const TextureSlot* other = slot.srgb ? readers.linear[i] : readers.srgb[i];
    if (own == nullptr) own = &slot;
    if (other == nullptr || readers.reported || is_two_level(phase, image, i)) continue;
    readers.reported = true;
    report_conflict(phase, slot, *other, image, kColors[i]);
  }
}

void check_color_spaces(const TexturePhase& phase) {
  std::map<std::uint32_t, Readers> readers;
  for (const TextureSlot& slot : phase.slots) {
    for (const std::uint32_t image : slot.images) {
      check_color_space(phase, slot, image, readers[image]);
    }
  }
}

// --- Placement of a texture ---

// The values that determine the texel at a point of a surface.
struct Placement {
  UvMapping uv;
  std::array<std::uint64_t, 4> sampling{10497, 10497, 0, 0};  // wrapS, wrapT, filters

  // The first difference, by its name in the text; empty: none.
  std::string_view difference(const Placement& other) const {
    const std::string_view found = uv.difference(other.uv);
    return found.empty() && sampling != other.sampling ? "sampler" : found;
  }
};

Placement placement_of(const Context& context, const TextureSlot& slot) {
  const json::Document& document = context.document;
  Placement placement;
  placement.uv = read_uv_mapping(document, slot.use->texture_info);
  if (!slot.sampler) return placement;
  const json::NodeId sampler = context.asset.elements(model::RootArray::samplers)[*slot.sampler];
  constexpr std::array<std::string_view, 4> kMembers{"wrapS", "wrapT", "magFilter", "minFilter"};
  for (std::size_t i = 0; i < kMembers.size(); ++i) {
    const auto value = model::unsigned_member(document, sampler, kMembers[i]);
    placement.sampling[i] = value.value_or(placement.sampling[i]);
  }
  return placement;
}

// --- Beyond the edge of an image ---

constexpr std::uint64_t kClampToEdge = 33071;

// Whether the square from 0 to 1 is moved or stretched outside the image, where the edge is
// repeated.
bool leaves_clamped(const Placement& placement, std::size_t axis) {
  if (placement.sampling[axis] != kClampToEdge || placement.uv.rotation != 0) return false;
  const double begin = placement.uv.offset[axis];
  const double end = begin + placement.uv.scale[axis];
  constexpr double kRounding = 1e-6;
  return std::min(begin, end) < -kRounding || std::max(begin, end) > 1 + kRounding;
}

void check_edges(const TexturePhase& phase, const TextureSlot& slot) {
  if (!slot.sampler || slot.effective.empty()) return;
  const Placement placement = placement_of(phase.context, slot);
  if (!leaves_clamped(placement, 0) && !leaves_clamped(placement, 1)) return;
  report_slot(
      phase.context, phase.sink, slot, Code::TEXTURE_TRANSFORM_CLAMPED,
      fmt::format("The transform of {} leaves the image, but its sampler clamps to the edge.",
                  slot.property));
}

// --- Channels of one image in one material ---

void check_packed(const TexturePhase& phase, const TextureSlot& slot, const TextureSlot& other) {
  if (slot.effective.overlaps(other.effective)) return;  // used twice, not packed
  const std::string_view difference =
      placement_of(phase.context, slot).difference(placement_of(phase.context, other));
  if (difference.empty()) return;
  report_slot(
      phase.context, phase.sink, slot, Code::TEXTURE_PACKING_DISAGREES,
      fmt::format("{} and {} share {}, but have a different {}.", slot.property, other.property,
                  image_label(phase.context, slot.images.front()), difference));
}

// Occlusion, roughness and metalness in R, G and B: one image instead of two.
void check_packable(const TexturePhase& phase, const TextureSlot& occlusion,
                    const TextureSlot& other) {
  const std::uint32_t image = occlusion.images.front();
  if (image == other.images.front()) return;
  const Header* header = phase.header(image);
  const Header* other_header = phase.header(other.images.front());
  if (header == nullptr || other_header == nullptr) return;
  if (header->width != other_header->width || header->height != other_header->height) return;
  const std::string_view difference =
      placement_of(phase.context, occlusion).difference(placement_of(phase.context, other));
  if (!difference.empty()) return;
  report_slot(
      phase.context, phase.sink, occlusion, Code::TEXTURE_PACKABLE,
      fmt::format("Occlusion in {} can be packed into R of {}.", image_label(phase.context, image),
                  image_label(phase.context, other.images.front())));
}

// The slots of one material, in the order of the text.
void check_material(const TexturePhase& phase, const std::vector<const TextureSlot*>& slots) {
  const TextureSlot* occlusion = nullptr;
  const TextureSlot* packed = nullptr;
  std::map<std::uint32_t, const TextureSlot*> first;  // by image
  for (const TextureSlot* slot : slots) {
    if (slot->property == "occlusionTexture") occlusion = slot;
    if (slot->property == "metallicRoughnessTexture") packed = slot;
    if (slot->effective.empty()) continue;
    const auto [other, fresh] = first.emplace(slot->images.front(), slot);
    if (!fresh) check_packed(phase, *slot, *other->second);
  }
  if (occlusion != nullptr && packed != nullptr) check_packable(phase, *occlusion, *packed);
}

}  // namespace

void check_sharing(const TexturePhase& phase) {
  check_color_spaces(phase);
  std::map<std::uint32_t, std::vector<const TextureSlot*>> materials;
  for (const TextureSlot& slot : phase.slots) {
    check_edges(phase, slot);
    if (slot.material != json::kNoNode) materials[slot.material_index].push_back(&slot);
  }
  for (const auto& [index, slots] : materials) check_material(phase, slots);
}

}  // namespace gltfx::validate
