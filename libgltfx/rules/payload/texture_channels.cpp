// SPDX-License-Identifier: Apache-2.0
// Whether an image has the channels that a slot reads, and whether the slot makes a difference.

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/fields.hpp"
#include "rules/context.hpp"
#include "rules/core/material_needs.hpp"
#include "rules/core/use.hpp"
#include "rules/payload/texture_phase.hpp"

namespace gltfx::validate {
namespace {

using image::Header;

std::string_view format_name(image::Format format) {
  switch (format) {
    case image::Format::png:
      return "PNG";
    case image::Format::jpeg:
      return "JPEG";
    case image::Format::webp:
      return "WebP";
    case image::Format::avif:
      return "AVIF";
    case image::Format::ktx2:
      break;
  }
  return "KTX2";
}

// The reason why alpha is 1 everywhere in an image, as a clause.
std::string why_opaque(const Header& header) {
  const std::string_view format = format_name(header.format);
  if (header.format == image::Format::jpeg) return "is a JPEG, which has no alpha";
  if (header.opaque) return fmt::format("is a {} with an opaque palette", format);
  return fmt::format("is {} {} without alpha", header.grey ? "a grayscale" : "a", format);
}

// --- Alpha that is data ---

// Whether a map of one channel was made for the texture of an earlier draft, which read R.
bool is_left_in_red(const TexturePhase& phase, const TextureSlot& slot, std::uint32_t image) {
  if (slot.property != "diffuseTransmissionTexture") return false;
  if (phase.header(image)->grey) return true;
  const codec::Image* pixels = phase.pixels.of(image);
  if (pixels == nullptr) return false;
  const bool only_red = pixels->channels >= 3 && pixels->statistics[1].greatest == 0 &&
                        pixels->statistics[2].greatest == 0;
  return pixels->grey || only_red;
}

void report_alpha(const TexturePhase& phase, const TextureSlot& slot, std::uint32_t image) {
  const Header& header = *phase.header(image);
  const std::string label = image_label(phase.context, image);
  if (is_left_in_red(phase, slot, image)) {
    report_slot(phase.context, phase.sink, slot, Code::TEXTURE_TRANSLUCENCY_IN_RED,
                fmt::format("{} reads A, but {} {}; its translucency map is in R.", slot.property,
                            label, why_opaque(header)),
                "run 'gltfx upgrade' to move it to A");
    return;
  }
  std::string help;
  if (slot.property == "diffuseTransmissionTexture") {
    help = "move the map to A; for a translucency map in R, run 'gltfx upgrade'";
  }
  const bool only_alpha = slot.channels.colors() == 0;
  report_slot(phase.context, phase.sink, slot, Code::TEXTURE_ALPHA_MISSING,
              fmt::format("{} reads A, but {} {}, so alpha is 1{}.", slot.property, label,
                          why_opaque(header), only_alpha ? " and the texture has no effect" : ""),
              std::move(help));
}

void check_alpha(const TexturePhase& phase, const TextureSlot& slot) {
  if (slot.coverage || !slot.effective.has('a')) return;
  for (const std::uint32_t image : slot.images) {
    const Header* header = phase.header(image);
    if (header == nullptr || image::can_be_transparent(*header)) continue;
    report_alpha(phase, slot, image);
    return;
  }
}

// --- Bits ---

// Core slots that are sRGB have 8 bits; extensions do not define a bit depth.
void check_bits(const TexturePhase& phase, const TextureSlot& slot) {
  const schema::TypeId owner = slot.use->owner_type;
  if (!slot.srgb || owner == schema::kNone) return;
  if (phase.context.schemas.type(owner).extension != schema::kNone) return;
  for (const std::uint32_t image : slot.images) {
    const Header* header = phase.header(image);
    if (header == nullptr || header->format != image::Format::png || header->bits <= 8) continue;
    report_slot(phase.context, phase.sink, slot, Code::TEXTURE_NOT_8_BIT,
                fmt::format("{} must have 8 bits per channel, but {} has {}.", slot.property,
                            image_label(phase.context, image), header->bits));
    return;
  }
}

// --- Colors that are data ---

// The reason why R, G and B of an image are equal, as the end of a sentence; empty if they differ
// or it is unknown.
std::string why_equal(const TexturePhase& phase, const TextureSlot& slot, std::uint32_t image) {
  const Header* header = phase.header(image);
  if (header == nullptr || header->channels == image::Channels::red) return {};
  const std::string_view height_map = slot.normal_map ? "; it may be a height map" : "";
  if (header->grey) return fmt::format("is grayscale{}", height_map);
  const codec::Image* pixels = phase.pixels.of(image);
  if (pixels == nullptr || !pixels->grey) return {};
  if (!pixels->statistics[0].constant()) {
    return fmt::format("has equal color channels{}", height_map);
  }
  // A single value everywhere is harmless where it is multiplied by factors.
  return slot.normal_map ? "is grayscale in every texel" : "";
}

void check_equal_channels(const TexturePhase& phase, const TextureSlot& slot) {
  if (slot.srgb || slot.effective.colors() < 2) return;
  for (const std::uint32_t image : slot.images) {
    const std::string why = why_equal(phase, slot, image);
    if (why.empty()) continue;
    ChannelSet colors = slot.effective;
    colors.remove('a');
    report_slot(phase.context, phase.sink, slot, Code::TEXTURE_CHANNELS_EQUAL,
                fmt::format("{} reads different data from {}, but {} {}.", slot.property,
                            colors.text(), image_label(phase.context, image), why));
    return;
  }
}

// --- Factors of 0 ---

// The owner of the factor that hides a texture: the owner of the slot, or the texture info itself.
json::NodeId factor_owner(const TextureSlot& slot) {
  const bool own = slot.hidden_by == "scale" || slot.hidden_by == "strength";
  return own ? slot.use->texture_info : slot.use->owner;
}

std::string why_hidden(const TexturePhase& phase, const TextureSlot& slot) {
  if (slot.hidden_by.empty()) return "its factors are 0";
  const json::Document& document = phase.context.document;
  const bool written = document.find(factor_owner(slot), slot.hidden_by) != json::kNoNode;
  return fmt::format("{} is {}", slot.hidden_by, written ? "0" : "not set (default: 0)");
}

// One finding for each factor, on the first texture that it hides.
void check_factors(const TexturePhase& phase) {
  std::set<std::pair<json::NodeId, std::string_view>> reported;
  const bool removable = unseen_user(phase.context).empty();
  for (const TextureSlot& slot : phase.slots) {
    if (slot.channels.empty() || !slot.effective.empty()) continue;
    if (!reported.emplace(factor_owner(slot), slot.hidden_by).second) continue;
    report_slot(phase.context, phase.sink, slot, Code::TEXTURE_FACTOR_ZERO,
                fmt::format("{} has no effect because {}.", slot.property, why_hidden(phase, slot)),
                fmt::format("set {}{}", slot.hidden_by.empty() ? "the factors" : slot.hidden_by,
                            removable ? ", or remove the texture" : ""));
  }
}

// --- Alpha that is coverage ---

bool has_factor_alpha(const TexturePhase& phase, const TextureSlot& slot) {
  const std::string& member = slot.use->slot->scaled_by;
  const std::vector<double> factor = factor_of(phase.context, *slot.use, member);
  if (factor.size() == 4 && factor[3] != 1) return true;
  return phase.animated.contains(sibling_pointer(slot, member));
}

// Alpha as far as known from headers and decoded pixels.
bool may_be_transparent(const TexturePhase& phase, std::uint32_t image) {
  const Header* header = phase.header(image);
  if (header == nullptr) return true;
  if (!image::can_be_transparent(*header)) return false;
  const codec::Image* pixels = phase.pixels.of(image);
  return pixels == nullptr || !pixels->has_alpha() || pixels->alpha().least != pixels->full();
}

void check_missing_coverage(const TexturePhase& phase, const TextureSlot& slot,
                            const VertexAlpha& vertices) {
  if (!slot.channels.has('a') || has_factor_alpha(phase, slot)) return;
  if (slot.material != json::kNoNode && vertices.on(slot.material_index)) return;
  if (std::any_of(slot.images.begin(), slot.images.end(),
                  [&](std::uint32_t image) { return may_be_transparent(phase, image); })) {
    return;
  }
  const std::string mode = model::string_member(phase.context.document, slot.material, "alphaMode");
  const Header& header = *phase.header(slot.images.front());
  const std::string why =
      image::can_be_transparent(header) ? "has an alpha of 1 in every texel" : why_opaque(header);
  report_slot(phase.context, phase.sink, slot, Code::MATERIAL_ALPHA_MISSING,
              fmt::format("alphaMode is {}, but {} {}, so the surface is opaque.", mode,
                          image_label(phase.context, slot.images.front()), why));
}

// Images with a slot that reads alpha.
std::set<std::uint32_t> images_read_for_alpha(const TexturePhase& phase) {
  std::set<std::uint32_t> read;
  for (const TextureSlot& slot : phase.slots) {
    if (slot.channels.has('a')) read.insert(slot.images.begin(), slot.images.end());
  }
  return read;
}

// Unused alpha: a surface that was meant to have holes, or wasted bytes.
void check_unused_alpha(const TexturePhase& phase, const TextureSlot& slot,
                        const std::set<std::uint32_t>& read) {
  const std::uint32_t image = slot.images.front();
  const Header* header = phase.header(image);
  if (header == nullptr || !image::can_be_transparent(*header) || read.count(image) != 0) return;
  const auto& ktx2 = phase.resources.images[image].ktx2;
  if (ktx2 && !ktx2->contents) return;  // unknown
  const codec::Image* pixels = phase.pixels.of(image);
  const bool looked = pixels != nullptr && pixels->has_alpha();
  const bool opaque = looked && pixels->alpha().least == pixels->full();
  const std::string label = image_label(phase.context, image);
  if (opaque) {
    report_slot(phase.context, phase.sink, slot, Code::TEXTURE_ALPHA_OPAQUE,
                fmt::format("The alpha channel of {} is 1 in every texel.", label));
  } else {
    report_slot(phase.context, phase.sink, slot, Code::TEXTURE_ALPHA_UNUSED,
                fmt::format("The base color uses {}, which has {}, but alphaMode is OPAQUE.", label,
                            looked ? "transparent texels" : "an alpha channel"));
  }
}

void check_coverage(const TexturePhase& phase) {
  const VertexAlpha vertices(phase.context);
  const std::set<std::uint32_t> read = images_read_for_alpha(phase);
  for (const TextureSlot& slot : phase.slots) {
    if (!slot.coverage) continue;
    check_missing_coverage(phase, slot, vertices);
    check_unused_alpha(phase, slot, read);
  }
}

}  // namespace

void check_channels(const TexturePhase& phase) {
  check_factors(phase);
  for (const TextureSlot& slot : phase.slots) {
    check_alpha(phase, slot);
    check_bits(phase, slot);
    check_equal_channels(phase, slot);
  }
  check_coverage(phase);
}

}  // namespace gltfx::validate
