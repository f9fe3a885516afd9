// SPDX-License-Identifier: Apache-2.0
// Primitives that have materials for variants only.
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/fields.hpp"
#include "rules/finding.hpp"
#include "rules/shows/shows.hpp"

namespace gltfx::validate {
namespace {

bool has_mappings(const json::Document& document, const model::Primitive& primitive) {
  const json::NodeId extensions = model::object_member(document, primitive.node, "extensions");
  if (extensions == json::kNoNode) return false;
  const json::NodeId object = model::object_member(document, extensions, "KHR_materials_variants");
  const json::NodeId mappings =
      object == json::kNoNode ? object : document.find(object, "mappings");
  return mappings != json::kNoNode && document.kind(mappings) == json::Kind::array &&
         document.array_size(mappings) > 0;
}

}  // namespace

void check_variants(DataPhase& phase) {
  const Context& context = phase.context;
  if (context.document.find(context.document.root(), "extensions") == json::kNoNode) return;
  std::optional<std::pair<std::size_t, std::size_t>> first;
  std::uint64_t count = 0;
  std::uint64_t all = 0;
  const auto& meshes = context.views.meshes;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    for (std::size_t k = 0; k < meshes[i].primitives.size(); ++k) {
      const model::Primitive& primitive = meshes[i].primitives[k];
      if (primitive.node == json::kNoNode || !has_mappings(context.document, primitive)) continue;
      ++all;
      if (primitive.material_node != json::kNoNode) continue;
      ++count;
      if (!first) first.emplace(i, k);
    }
  }
  if (!first) return;
  report_at(phase.sink, fmt::format("/meshes/{}/primitives/{}", first->first, first->second),
            finding_on(context, meshes[first->first].primitives[first->second].node,
                       Code::VARIANT_WITHOUT_DEFAULT,
                       fmt::format("Until a variant is chosen, {} of {} primitive{} with variants "
                                   "ha{} no material and {} white.",
                                   count, all, all == 1 ? "" : "s", count == 1 ? "s" : "ve",
                                   count == 1 ? "is" : "are")));
}

}  // namespace gltfx::validate
