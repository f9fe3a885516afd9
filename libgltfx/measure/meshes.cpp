// SPDX-License-Identifier: Apache-2.0
// Meshes and primitives as accessors declare them: no vertex is read.
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "base/checked.hpp"
#include "measure/mesh_memory.hpp"
#include "measure/take.hpp"
#include "model/fields.hpp"
#include "model/info.hpp"

namespace gltfx::measure {
namespace {

using model::Mode;
using model::Primitive;
using model::SemanticKind;

// The sizes of a primitive.
struct PrimitiveCounts {
  std::uint64_t triangles = 0, lines = 0, points = 0, vertices = 0;
};

std::uint64_t lines_of(Mode mode, std::uint64_t indices) {
  if (mode == Mode::lines) return indices / 2;
  if (mode == Mode::line_loop) return indices < 2 ? 0 : indices;
  return mode == Mode::line_strip && indices > 1 ? indices - 1 : 0;
}

PrimitiveCounts counts_of(const model::Views& views, const Primitive& primitive) {
  const model::PrimitiveSize size = model::primitive_size(views, primitive);
  PrimitiveCounts counts;
  counts.triangles = size.triangles;
  counts.vertices = size.vertices;
  const std::uint64_t indices =
      primitive.indices ? views.accessors[*primitive.indices].count.value_or(0) : size.vertices;
  if (!primitive.mode) return counts;
  counts.lines = lines_of(*primitive.mode, indices);
  if (*primitive.mode == Mode::points) counts.points = indices;
  return counts;
}

std::uint64_t sets_of(const Primitive& primitive, SemanticKind kind) {
  return static_cast<std::uint64_t>(
      std::count_if(primitive.attributes.begin(), primitive.attributes.end(),
                    [&](const model::Attribute& each) { return each.semantic.kind == kind; }));
}

std::vector<std::string> attribute_names(const Primitive& primitive) {
  std::vector<std::string> names;
  for (const model::Attribute& attribute : primitive.attributes) names.emplace_back(attribute.name);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

void take_primitive(Taking& taking, const Primitive& primitive, std::size_t element) {
  const auto set = [&](Name name, auto value) {
    Column* column = taking.column(MeasureScope::primitive, name);
    if (column != nullptr) column->set(element, value());
  };
  const model::Views& views = taking.source().views();
  const PrimitiveCounts counts = counts_of(views, primitive);
  set(Name::triangles, [&] { return counts.triangles; });
  set(Name::lines, [&] { return counts.lines; });
  set(Name::points, [&] { return counts.points; });
  set(Name::vertices, [&] { return counts.vertices; });
  set(Name::uv_sets, [&] { return sets_of(primitive, SemanticKind::texcoord); });
  set(Name::color_sets, [&] { return sets_of(primitive, SemanticKind::color); });
  set(Name::vertex_bytes, [&] { return model::vertex_bytes(views, primitive); });
  set(Name::attributes, [&] { return MeasureValue(attribute_names(primitive)); });
  if (primitive.mode) {
    set(Name::mode, [&] { return MeasureValue(std::string(model::mode_name(*primitive.mode))); });
  }
  Column* bits = taking.column(MeasureScope::primitive, Name::index_bits);
  if (bits == nullptr) return;
  if (!primitive.indices) return bits->does_not_apply(element, "The primitive has no indices.");
  const model::Format& format = views.accessors[*primitive.indices].format;
  bits->set(element, std::uint64_t{8} * model::component_size(format.component));
}

// An accessor that several primitives of a mesh share counts once.
std::uint64_t vertices_of(const model::Views& views, const model::Mesh& mesh) {
  std::vector<std::uint32_t> positions;
  std::uint64_t vertices = 0;
  for (const Primitive& primitive : mesh.primitives) {
    const model::Attribute* position = primitive.find(SemanticKind::position);
    if (position != nullptr && position->accessor) positions.push_back(*position->accessor);
  }
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  for (const std::uint32_t accessor : positions) {
    vertices = saturating_add(vertices, views.accessors[accessor].count.value_or(0));
  }
  return vertices;
}

std::uint64_t materials_of(const model::Mesh& mesh) {
  std::set<std::uint32_t> materials;
  for (const Primitive& primitive : mesh.primitives) {
    if (primitive.material) materials.insert(*primitive.material);
  }
  return materials.size();
}

void take_mesh(Taking& taking, const model::Mesh& mesh, std::size_t element) {
  const model::Views& views = taking.source().views();
  const auto set = [&](Name name, auto value) {
    if (Column* column = taking.column(MeasureScope::mesh, name)) column->set(element, value());
  };
  PrimitiveCounts sum;
  for (const Primitive& primitive : mesh.primitives) {
    const PrimitiveCounts counts = counts_of(views, primitive);
    sum.triangles = saturating_add(sum.triangles, counts.triangles);
    sum.lines = saturating_add(sum.lines, counts.lines);
    sum.points = saturating_add(sum.points, counts.points);
  }
  const std::uint64_t targets =
      mesh.primitives.empty() ? 0 : mesh.primitives.front().targets.size();
  const std::uint64_t vertices = vertices_of(views, mesh);
  set(Name::triangles, [&] { return sum.triangles; });
  set(Name::lines, [&] { return sum.lines; });
  set(Name::points, [&] { return sum.points; });
  set(Name::vertices, [&] { return vertices; });
  set(Name::primitives, [&] { return std::uint64_t{mesh.primitives.size()}; });
  set(Name::materials, [&] { return materials_of(mesh); });
  set(Name::morph_targets, [&] { return targets; });
  set(Name::morph_vertices, [&] { return targets > 0 ? vertices : 0; });
}

}  // namespace

std::uint64_t mesh_memory(const Source& source) {
  const model::Views& views = source.views();
  std::vector<bool> counted(views.accessors.size());
  std::uint64_t sum = 0;
  const auto add = [&](const std::optional<std::uint32_t>& index) {
    if (!index || counted[*index]) return;
    counted[*index] = true;
    const model::Accessor& accessor = views.accessors[*index];
    const Checked bytes =
        checked_mul(accessor.count.value_or(0), model::packed_stride(accessor.format));
    sum = saturating_add(sum, bytes.value_or(UINT64_MAX));
  };
  for (const model::Mesh& mesh : views.meshes) {
    for (const model::Primitive& primitive : mesh.primitives) {
      add(primitive.indices);
      for (const model::Attribute& attribute : primitive.attributes) add(attribute.accessor);
      for (const json::NodeId target : primitive.targets) {
        for (const auto& attribute : model::read_attributes(source.asset(), target)) {
          add(attribute.accessor);
        }
      }
    }
  }
  return sum;
}

void take_meshes(Taking& taking) {
  const auto& meshes = taking.source().views().meshes;
  for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh) {
    take_mesh(taking, meshes[mesh], mesh);
    for (std::size_t i = 0; i < meshes[mesh].primitives.size(); ++i) {
      take_primitive(taking, meshes[mesh].primitives[i], taking.first_primitive(mesh) + i);
    }
  }
  if (Column* column = taking.column(MeasureScope::asset, Name::gpu_mesh_bytes)) {
    column->set(0, mesh_memory(taking.source()));
  }
  // The materials of an asset are those of its array.
  if (Column* column = taking.column(MeasureScope::asset, Name::materials)) {
    column->set(0, std::uint64_t{taking.source().asset().count(model::RootArray::materials)});
  }
}

}  // namespace gltfx::measure
