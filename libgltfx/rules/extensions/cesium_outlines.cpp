// SPDX-License-Identifier: Apache-2.0
// CESIUM_primitive_outline: pairs of vertices that an edge joins. CESIUM_tile_edges: vertices along
// the edges of a tile. The checks need the indices, so this file names the extensions.
#include <algorithm>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"
#include "rules/payload/topology.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kOutlinesExtension = "CESIUM_primitive_outline";
constexpr std::string_view kTileEdgesExtension = "CESIUM_tile_edges";

void check_pairs(DataPhase& phase, json::NodeId object, const Indices& pairs,
                 const std::vector<std::uint64_t>& edges, const Path& path) {
  std::size_t errors = 0;
  std::size_t first = 0;
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
    if (std::binary_search(edges.begin(), edges.end(), edge_of(pairs[i], pairs[i + 1]))) continue;
    if (errors++ == 0) first = i;
  }
  if (errors == 0) return;
  std::string message =
      fmt::format("The segment between vertices {} and {} is not a triangle edge.", pairs[first],
                  pairs[first + 1]);
  if (errors > 1) message += fmt::format(" This is the first of {}.", errors);
  report_member(phase.sink, phase.context, path, object, "indices", Code::OUTLINE_NOT_AN_EDGE,
                std::move(message));
}

void check_outline(DataPhase& phase, const ExtensionPlace& place, const Path& path) {
  const Context& context = phase.context;
  const model::Primitive primitive = model::read_primitive(context.asset, place.host);
  if (primitive.mode &&
      (*primitive.mode != model::Mode::triangles || primitive.indices_node == json::kNoNode)) {
    phase.sink.report(
        path, finding_on(context, place.object, Code::OUTLINE_NOT_TRIANGLES,
                         *primitive.mode == model::Mode::triangles
                             ? std::string("The primitive has no indices.")
                             : fmt::format("The mode of the primitive is {}; it must be TRIANGLES.",
                                           model::mode_name(*primitive.mode))));
    return;
  }
  const auto index = context.asset.index(place.object, "indices", model::RootArray::accessors);
  if (!index) return;
  const auto pairs = read_indices(phase, *index);
  const auto triangles = read_triangles(phase, primitive);
  if (pairs && triangles) check_pairs(phase, place.object, *pairs, edges_of(*triangles), path);
}

void check_tile_edges(DataPhase& phase, const ExtensionPlace& place, const Path& path) {
  const Context& context = phase.context;
  const model::Primitive primitive = model::read_primitive(context.asset, place.host);
  const model::Attribute* position = primitive.find(model::SemanticKind::position);
  const auto count = position != nullptr && position->accessor
                         ? context.views.accessors[*position->accessor].count
                         : std::nullopt;
  if (!count) return;
  for (const std::string_view edge : {"left", "bottom", "right", "top"}) {
    const auto accessor = context.asset.index(place.object, edge, model::RootArray::accessors);
    const auto vertices = accessor ? read_indices(phase, *accessor) : std::nullopt;
    if (!vertices || vertices->empty()) continue;
    const std::uint32_t greatest = *std::max_element(vertices->begin(), vertices->end());
    if (greatest < *count) continue;
    report_member(phase.sink, context, path, place.object, edge, Code::TILE_EDGE_VERTEX_OOB,
                  fmt::format("The edge has vertex {}, but the primitive has {} vertices.",
                              greatest, *count));
  }
}

}  // namespace

void check_outlines(DataPhase& phase) {
  for_each_primitive_extension(
      phase.context, kOutlinesExtension,
      [&](const ExtensionPlace& place, const Path& path) { check_outline(phase, place, path); });
  for_each_primitive_extension(
      phase.context, kTileEdgesExtension,
      [&](const ExtensionPlace& place, const Path& path) { check_tile_edges(phase, place, path); });
}

}  // namespace gltfx::validate
