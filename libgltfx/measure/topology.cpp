// SPDX-License-Identifier: Apache-2.0
// The surface of each mesh in its own space: all primitives together.
#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <string_view>
#include <utility>

#include "measure/scene_area.hpp"
#include "measure/shape.hpp"
#include "measure/surface.hpp"
#include "measure/take.hpp"
#include "measure/weld.hpp"

namespace gltfx::measure {
namespace {

/// The measures of a mesh, or why there are none.
struct MeshValues {
  std::string_view why;
  bool fault = false;  ///< `why` is a fault
  bool empty = false;  ///< there are no triangles with an area
  double area = 0;
  double volume = 0;
  std::uint64_t degenerate = 0, duplicates = 0, shells = 0;
  EdgeCounts edges;
};

constexpr std::array kOfEdges{Name::open_edges,           Name::non_manifold_edges,
                              Name::flipped_edges,        Name::closed,
                              Name::hard_edges,           Name::volume,
                              Name::non_manifold_vertices};
constexpr std::array kOthers{Name::shells, Name::duplicate_triangles, Name::degenerate_triangles};

bool wants_one_of(const Taking& taking, std::span<const Name> names) {
  return std::any_of(names.begin(), names.end(), [&](Name name) { return taking.wants(name); });
}

bool wants_meshes(Taking& taking) {
  return taking.column(MeasureScope::mesh, Name::surface_area) != nullptr ||
         wants_one_of(taking, kOfEdges) || wants_one_of(taking, kOthers);
}

class MeshMeasurer {
 public:
  explicit MeshMeasurer(Taking& taking)
      : taking_(taking), budget_(geometry_bytes(taking.source())) {}

  void run() {
    const auto& meshes = taking_.source().views().meshes;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      auto key = shape_key(taking_.source(), meshes[i]);
      auto known = known_.find(key);
      if (known == known_.end()) known = known_.emplace(std::move(key), measure(meshes[i])).first;
      store(i, known->second);
    }
  }

 private:
  MeshValues measure(const model::Mesh& mesh) {
    MeshValues values;
    Shape shape;
    values.why = read_shape(taking_.source(), mesh, budget_, shape);
    values.fault = !values.why.empty();
    if (values.fault) return values;
    if (shape.triangles.empty() && shape.collapsed == 0) {
      values.why = "The mesh has no triangles.";
      return values;
    }
    if (!weld(shape.positions, shape.triangles, taking_.parameters().weld)) {
      values.why = "Too many vertices lie within the welding distance.";
      values.fault = true;
      return values;
    }
    const Surface surface = make_surface(std::move(shape.positions), std::move(shape.triangles));
    values.empty = surface.triangles.empty();
    values.area = surface.area;
    values.degenerate = surface.degenerate + shape.collapsed;
    count(surface, values);
    return values;
  }

  void count(const Surface& surface, MeshValues& values) {
    if (wants_one_of(taking_, kOfEdges)) {
      values.edges = count_edges(surface, taking_.parameters().hard_angle,
                                 taking_.wants(Name::non_manifold_vertices));
    }
    if (taking_.wants(Name::volume)) values.volume = enclosed_volume(surface);
    if (taking_.wants(Name::shells)) values.shells = count_shells(surface);
    if (taking_.wants(Name::duplicate_triangles)) values.duplicates = count_duplicates(surface);
  }

  void store(std::size_t mesh, const MeshValues& values) {
    const auto set = [&](Name name, MeasureValue value, std::string_view none = {}) {
      Column* column = taking_.column(MeasureScope::mesh, name);
      if (column == nullptr) return;
      if (values.fault) {
        column->could_not_be_taken(mesh, values.why);
      } else if (!values.why.empty() || !none.empty()) {
        column->does_not_apply(mesh, values.why.empty() ? none : values.why);
      } else {
        column->set(mesh, std::move(value));
      }
    };
    const auto number = [](std::uint64_t count) { return static_cast<double>(count); };
    const std::string_view empty = values.empty ? "No triangle of the mesh has an area." : "";
    const std::string_view open = values.edges.closed() ? empty : "The mesh is not closed.";
    set(Name::surface_area, values.area);
    set(Name::degenerate_triangles, number(values.degenerate));
    set(Name::duplicate_triangles, number(values.duplicates));
    set(Name::shells, number(values.shells));
    set(Name::open_edges, number(values.edges.open));
    set(Name::non_manifold_edges, number(values.edges.non_manifold));
    set(Name::flipped_edges, number(values.edges.flipped));
    set(Name::hard_edges, number(values.edges.hard));
    set(Name::non_manifold_vertices, number(values.edges.non_manifold_vertices));
    set(Name::closed, values.edges.closed(), empty);
    set(Name::volume, values.volume, open);
  }

  Taking& taking_;
  model::MemoryBudget budget_;
  std::map<std::vector<std::uint64_t>, MeshValues> known_;  // by shape_key()
};

}  // namespace

void take_topology(Taking& taking) {
  if (wants_meshes(taking)) MeshMeasurer(taking).run();
  Column* scenes = taking.column(MeasureScope::scene, Name::surface_area);
  if (scenes != nullptr) take_scene_areas(taking, *scenes);
}

}  // namespace gltfx::measure
