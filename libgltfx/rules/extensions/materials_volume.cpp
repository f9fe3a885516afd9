// SPDX-License-Identifier: Apache-2.0
// KHR_materials_volume: a surface that encloses a volume has no hole. The material declares the
// volume and the triangles form the surface, so this file names the extension.
#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/fields.hpp"
#include "rules/collector.hpp"
#include "rules/finding.hpp"
#include "rules/payload/topology.hpp"

namespace gltfx::validate {
namespace {

bool is_thick(const Context& context, std::uint32_t material) {
  const json::NodeId object = model::extension_object(
      context.document, context.asset.elements(model::RootArray::materials)[material],
      "KHR_materials_volume");
  return model::number_member(context.document, object, "thicknessFactor").value_or(0) > 0;
}

// Edges of a surface that no second triangle shares, compared by position: at seams, vertices have
// the same position, or nearly.
class Boundary {
 public:
  explicit Boundary(DataPhase& phase) : phase_(phase) {}

  /// False if the primitive cannot be read.
  bool add(const model::Primitive& primitive) {
    const model::Attribute* position = primitive.find(model::SemanticKind::position);
    if (position == nullptr || !position->accessor || !primitive.mode) return false;
    if (*primitive.mode < model::Mode::triangles) return true;  // not a part of the surface
    const auto triangles = read_triangles(phase_, primitive);
    if (!triangles || !place(*position->accessor)) return false;
    for (Triangle each : *triangles) {
      for (std::uint32_t& corner : each) {
        if (corner >= first_.size()) return false;
        corner = first_[corner];
      }
      if (each[0] == each[1] || each[1] == each[2] || each[2] == each[0]) continue;
      for (std::size_t i = 0; i < 3; ++i) edges_.push_back(edge_of(each[i], each[(i + 1) % 3]));
    }
    return true;
  }

  /// Number of edges with an odd number of triangles.
  std::size_t open_edges() {
    std::sort(edges_.begin(), edges_.end());
    std::size_t open = 0;
    for (std::size_t i = 0; i < edges_.size();) {
      const auto end = std::upper_bound(edges_.begin() + static_cast<std::ptrdiff_t>(i),
                                        edges_.end(), edges_[i]);
      const auto next = static_cast<std::size_t>(end - edges_.begin());
      open += (next - i) % 2;
      i = next;
    }
    return open;
  }

 private:
  // Vertices of several accessors would have to be compared with each other.
  bool place(std::uint32_t accessor) {
    if (placed_) return accessor_ == accessor;
    auto first = first_near_position(phase_, accessor);
    if (!first) return false;
    first_ = *std::move(first);
    accessor_ = accessor;
    placed_ = true;
    return true;
  }

  DataPhase& phase_;
  bool placed_ = false;
  std::uint32_t accessor_ = 0;
  Indices first_;
  std::vector<std::uint64_t> edges_;
};

void check_mesh(DataPhase& phase, const model::Mesh& mesh, std::size_t index) {
  const Context& context = phase.context;
  const bool thick = std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                                 [&](const model::Primitive& each) {
                                   return each.material && is_thick(context, *each.material);
                                 });
  if (!thick) return;
  Boundary boundary(phase);
  for (const model::Primitive& each : mesh.primitives) {
    if (!boundary.add(each)) return;
  }
  const std::size_t open = boundary.open_edges();
  if (open == 0) return;
  report_element(
      phase.sink, context, model::RootArray::meshes, index, Code::KHR_MATERIALS_VOLUME_NOT_CLOSED,
      fmt::format("The mesh has a volume, but {} of its edges have only one triangle.", open));
}

}  // namespace

void check_volumes(DataPhase& phase) {
  if (!is_enabled(phase.context.options, Code::KHR_MATERIALS_VOLUME_NOT_CLOSED)) return;
  const auto& meshes = phase.context.views.meshes;
  for (std::size_t i = 0; i < meshes.size(); ++i) check_mesh(phase, meshes[i], i);
}

}  // namespace gltfx::validate
