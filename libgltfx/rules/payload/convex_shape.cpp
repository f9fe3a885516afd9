// SPDX-License-Identifier: Apache-2.0
// Shapes of meshes (glTF 2.1): convex ones are convex, and surfaces are closed.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "measure/shape.hpp"
#include "measure/surface.hpp"
#include "measure/weld.hpp"
#include "model/shape.hpp"
#include "rules/collector.hpp"
#include "rules/finding.hpp"
#include "rules/payload/convexity.hpp"
#include "rules/payload/phases.hpp"

namespace gltfx::validate {
namespace {

using model::RootArray;

// What the mesh of a shape is found to be.
struct ShapeSurface {
  bool read = false;
  measure::EdgeCounts edges;
  Convexity convexity;
};

// The weights of a mesh itself: those of nodes do not move a shape.
std::vector<float> own_weights(const Context& context, const model::Mesh& mesh) {
  std::vector<float> weights(mesh.primitives.front().targets.size());
  const bool known =
      model::read_floats(context.document, context.document.find(mesh.node, "weights"),
                         weights.size(), weights.data());
  return known ? weights : std::vector<float>();
}

class ShapeCheck {
 public:
  explicit ShapeCheck(DataPhase& phase)
      : phase_(phase),
        context_(phase.context),
        budget_(measure::geometry_bytes(phase.measured)),
        wants_closed_(is_enabled(context_.options, Code::SHAPE_NOT_CLOSED)) {}

  void run() {
    const std::vector<model::ShapeObject> shapes = model::read_shapes(context_.asset);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const model::ShapeObject& shape = shapes[i];
      if (!shape.mesh || (!shape.is_convex() && !wants_closed_)) continue;
      const auto key = std::pair(*shape.mesh, shape.is_convex());
      auto known = known_.find(key);
      if (known == known_.end()) known = known_.emplace(key, look_at(shape)).first;
      if (!known->second.read) continue;
      if (shape.is_convex()) judge(i, shape, known->second.convexity);
      if (!is_closed(known->second.edges)) {
        report(i, shape, Code::SHAPE_NOT_CLOSED, open_text(known->second.edges));
      }
    }
  }

 private:
  ShapeSurface look_at(const model::ShapeObject& shape) {
    ShapeSurface found;
    const model::Mesh& mesh = context_.views.meshes[*shape.mesh];
    if (mesh.primitives.size() != 1 || !measure::draws_triangles(mesh.primitives.front())) {
      return found;
    }
    const std::vector<float> weights = own_weights(context_, mesh);
    model::GeometryRequest request;
    request.weights = weights;
    request.surface = false;
    model::Geometry geometry;
    const auto error = model::read_geometry(phase_.measured.geometry(), mesh.primitives.front(),
                                            request, budget_, geometry);
    if (error != model::GeometryError::none) return found;
    // Its welded copy, and the lists of edges and boxes.
    constexpr std::uint64_t kEach = 128;
    if (!budget_.take(checked_mul(geometry.positions.size() + geometry.triangles.size(), kEach)) ||
        !measure::weld(geometry.positions, geometry.triangles, 0)) {
      return found;
    }
    const measure::Surface surface =
        measure::make_surface(std::move(geometry.positions), std::move(geometry.triangles));
    found.read = true;
    if (wants_closed_) found.edges = measure::count_edges(surface, 180, true);
    if (shape.is_convex()) found.convexity = find_convexity(surface);
    return found;
  }

  static bool is_closed(const measure::EdgeCounts& edges) {
    return edges.closed() && edges.non_manifold_vertices == 0;
  }
  static std::string open_text(const measure::EdgeCounts& edges) {
    return fmt::format(
        "is no closed and manifold surface: {} edges have one triangle, {} have more than two, {} "
        "have two that face in opposite directions, and {} vertices join parts that share no edge "
        "there.",
        edges.open, edges.non_manifold, edges.flipped, edges.non_manifold_vertices);
  }

  void judge(std::size_t index, const model::ShapeObject& shape, const Convexity& found) {
    switch (found.kind) {
      case Convexity::Kind::flat:
        return report(index, shape, Code::SHAPE_NOT_CONVEX,
                      "has no volume: all vertices of its triangles lie in one plane.");
      case Convexity::Kind::dented:
        return report(
            index, shape, Code::SHAPE_NOT_CONVEX,
            fmt::format("is not convex: one of its triangles has vertices on both sides of its "
                        "plane, {:.3g} away, {:.3g} % of the diagonal.",
                        found.depth, 100 * found.depth / found.diagonal));
      case Convexity::Kind::convex:
        if (found.inward != 0) {
          report(index, shape, Code::SHAPE_INSIDE_OUT,
                 fmt::format("is wound inwards: {} of {} triangles face its center.", found.inward,
                             found.triangles));
        }
        if (found.origin_outside > 0) {
          report(index, shape, Code::SHAPE_ORIGIN_OUTSIDE,
                 fmt::format("does not contain the origin, which lies {:.3g} outside of it.",
                             found.origin_outside));
        }
        return;
      case Convexity::Kind::unknown:
        return;
    }
  }

  void report(std::size_t index, const model::ShapeObject& shape, Code code,
              const std::string& text) {
    report_at(
        phase_.sink, fmt::format("/shapes/{}/{}/mesh", index, shape.type),
        finding_on(context_, shape.mesh_value, code,
                   fmt::format("The shape is made of {}, which {}",
                               object_label(context_, RootArray::meshes, *shape.mesh), text)));
  }

  DataPhase& phase_;
  const Context& context_;
  model::MemoryBudget budget_;
  const bool wants_closed_;
  std::map<std::pair<std::uint32_t, bool>, ShapeSurface> known_;  ///< by mesh, and if convex
};

}  // namespace

void check_shape_surfaces(DataPhase& phase) {
  if (phase.context.version > schema::kVersion2) ShapeCheck(phase).run();
}

}  // namespace gltfx::validate
