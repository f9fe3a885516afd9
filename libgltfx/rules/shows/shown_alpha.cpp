// SPDX-License-Identifier: Apache-2.0
// Alpha of the texels that triangles show.
#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "measure/texel_mask.hpp"
#include "model/material.hpp"
#include "model/texture.hpp"
#include "rules/core/material_needs.hpp"
#include "rules/finding.hpp"
#include "rules/payload/texture_phase.hpp"
#include "rules/shows/shows.hpp"
#include "rules/shows/uv_reading.hpp"

namespace gltfx::validate {
namespace {

// The texels that the primitives show; nothing: they cannot be read, or are too many.
std::optional<measure::TexelMask> shown_texels(DataPhase& phase, const TextureSlot& slot,
                                               const codec::Image& image,
                                               const std::vector<PlacedPrimitive>& users) {
  const model::Asset& asset = phase.context.asset;
  const json::NodeId texture = asset.elements(model::RootArray::textures)[slot.texture];
  measure::TexelMask mask(image.width, image.height, model::read_texture(asset, texture).sampler);
  const UvMapping mapping = read_uv_mapping(phase.context.document, slot.use->texture_info);
  for (const PlacedPrimitive& user : users) {
    const auto uvs = open_uvs(phase, *user.primitive, set_of(mapping));
    if (!uvs) return std::nullopt;
    const auto surface = read_uvs(phase, *user.primitive, *uvs);
    if (!surface) return std::nullopt;
    for (std::size_t i = 0; i < surface->triangles.size(); ++i) {
      const measure::UvTriangle corners = surface->corners(i);
      if (!measure::is_finite(corners)) return std::nullopt;
      std::array<measure::TexelPoint, 3> texels{};
      for (std::size_t k = 0; k < 3; ++k) {
        texels[k] = mapped(corners[k], mapping);
        texels[k] = {texels[k][0] * image.width, texels[k][1] * image.height};
      }
      if (!mask.cover(texels)) return std::nullopt;
    }
  }
  return mask;
}

struct ShownCounts {
  std::uint64_t all = 0;
  std::uint64_t marked = 0;
};
ShownCounts count_shown(const measure::TexelMask& mask, const std::vector<std::uint64_t>& bits) {
  ShownCounts counts;
  mask.for_each([&](std::uint64_t texel) {
    ++counts.all;
    counts.marked += AlphaStudy::has(bits, texel) ? 1 : 0;
  });
  return counts;
}

void check_blended(DataPhase& phase, const TextureSlot& slot, const codec::Image& image,
                   const AlphaStudy& study, const std::vector<PlacedPrimitive>& users) {
  // Where nothing is transparent, the mode has another finding.
  const std::uint64_t least = image.alpha().least;
  if (least * 255 >= std::uint64_t{image.full()} * 250) return;
  const auto mask = shown_texels(phase, slot, image, users);
  if (!mask) return;
  const ShownCounts counts = count_shown(*mask, study.not_opaque);
  if (counts.all == 0 || counts.marked > 0) return;
  report_slot(phase.context, phase.sink, slot, Code::BLEND_SHOWS_OPAQUE,
              fmt::format("alphaMode is BLEND, but all {} texels of {} that the triangles show are "
                          "opaque.",
                          counts.all, image_label(phase.context, slot.images.front())));
}

void check_masked(DataPhase& phase, const TextureSlot& slot, const codec::Image& image,
                  const AlphaStudy& study, const std::vector<PlacedPrimitive>& users) {
  const auto mask = shown_texels(phase, slot, image, users);
  if (!mask) return;
  const ShownCounts counts = count_shown(*mask, study.between);
  if (counts.marked * 2 <= counts.all) return;
  report_slot(
      phase.context, phase.sink, slot, Code::MASK_ALPHA_GRADIENT,
      fmt::format("alphaMode is MASK, but {} of the {} texels of {} that the triangles show "
                  "are neither opaque nor transparent.",
                  counts.marked, counts.all, image_label(phase.context, slot.images.front())));
}

// Variants and animations may show other texels.
bool may_show_others(const DataPhase& phase) {
  const auto& used = phase.context.checked.extensions_used;
  return std::any_of(used.begin(), used.end(), [](const auto& each) {
    const std::string_view name(each);
    return name == "KHR_materials_variants" || name == "KHR_animation_pointer";
  });
}

}  // namespace

void check_shown_alpha(DataPhase& phase) {
  if (!phase.textures || may_show_others(phase)) return;
  const VertexAlpha vertices(phase.context);
  const auto users = primitives_of_materials(phase.context);
  for (const TextureSlot& slot : phase.textures->slots) {
    if (slot.material == json::kNoNode || !slot.coverage || !slot.effective.has('a')) continue;
    const std::uint32_t index = slot.images.front();
    const codec::Image* image = phase.textures->pixels.of(index);
    const AlphaStudy* study = phase.textures->pixels.alpha(index);
    if (image == nullptr || study == nullptr || vertices.on(slot.material_index)) continue;
    const auto material = model::read_material(phase.context.asset, slot.material_index);
    if (material.of(MaterialParameter::base_color)[3] < 1) continue;
    const auto& own = users[slot.material_index];
    if (own.empty()) continue;
    if (material.alpha_mode == model::AlphaMode::blend) {
      check_blended(phase, slot, *image, *study, own);
    } else if (material.alpha_mode == model::AlphaMode::mask) {
      check_masked(phase, slot, *image, *study, own);
    }
  }
}

}  // namespace gltfx::validate
