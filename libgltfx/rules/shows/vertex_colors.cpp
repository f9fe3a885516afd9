// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/elements.hpp"
#include "rules/finding.hpp"
#include "rules/payload/texture_phase.hpp"
#include "rules/shows/shows.hpp"

namespace gltfx::validate {
namespace {

bool is_black(DataPhase& phase, std::uint32_t accessor) {
  const auto data = phase.open(accessor);
  if (!data || data->implied() || data->components() < 3 || data->count() == 0) return false;
  constexpr float kBlack = 0.002F;
  const std::vector<float> first = model::element_at(*data, 0);
  if (first[0] > kBlack || first[1] > kBlack || first[2] > kBlack) return false;
  if (!phase.budget.take(data->count(), data->components())) return false;
  bool black = true;
  model::for_each_component(
      *data, static_cast<std::size_t>(data->count()),
      [&](std::size_t, unsigned k, float value) { black = black && (k == 3 || value <= kBlack); });
  return black;
}

}  // namespace

void check_vertex_colors(DataPhase& phase) {
  if (!phase.textures) return;
  // By material: the image of its base color.
  std::vector<std::optional<std::uint32_t>> images(
      phase.context.asset.count(model::RootArray::materials));
  for (const TextureSlot& slot : phase.textures->slots) {
    if (slot.material == json::kNoNode || !slot.coverage || slot.effective.colors() == 0) continue;
    images[slot.material_index] = slot.images.front();
  }
  const auto& meshes = phase.context.views.meshes;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    for (std::size_t k = 0; k < meshes[i].primitives.size(); ++k) {
      const model::Primitive& primitive = meshes[i].primitives[k];
      const model::Attribute* colors = primitive.find(model::SemanticKind::color);
      if (colors == nullptr || !colors->accessor || !primitive.targets.empty()) continue;
      if (!primitive.material || !images[*primitive.material]) continue;
      if (!is_black(phase, *colors->accessor)) continue;
      report_at(phase.sink,
                fmt::format("/meshes/{}/primitives/{}/attributes/{}", i, k, colors->name),
                finding_on(phase.context, colors->value, Code::VERTEX_COLORS_BLACK,
                           fmt::format("All vertices are black, so the primitive is, too, and {} "
                                       "cannot be seen.",
                                       image_label(phase.context, *images[*primitive.material]))));
    }
  }
}

}  // namespace gltfx::validate
