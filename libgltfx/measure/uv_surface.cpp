// SPDX-License-Identifier: Apache-2.0
#include "measure/uv_surface.hpp"

#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "measure/shape.hpp"

namespace gltfx::measure {
namespace {

template <class Element>
void append(std::vector<Element>& from, std::vector<Element>& to) {
  if (to.empty()) {
    to = std::move(from);
  } else {
    to.insert(to.end(), from.begin(), from.end());
  }
}

}  // namespace

std::vector<std::vector<MeasuredPrimitive>> primitives_by_material(const Taking& taking) {
  std::vector<std::vector<MeasuredPrimitive>> uses(taking.count(MeasureScope::material));
  const auto& meshes = taking.source().views().meshes;
  for (std::uint32_t mesh = 0; mesh < meshes.size(); ++mesh) {
    for (std::uint32_t i = 0; i < meshes[mesh].primitives.size(); ++i) {
      const model::Primitive& primitive = meshes[mesh].primitives[i];
      if (!draws_triangles(primitive)) continue;
      const std::size_t material =
          primitive.material ? *primitive.material : taking.plain_material();
      uses[material].push_back({mesh, i});
    }
  }
  return uses;
}

UvProblem read_uv_surface(const Source& source, std::span<const MeasuredPrimitive> primitives,
                          std::uint32_t set, model::MemoryBudget& budget, UvSurface& surface) {
  constexpr std::size_t kMostPoints = std::numeric_limits<std::uint32_t>::max() / 4;
  std::vector<const model::Primitive*> mapped;
  for (const auto& [mesh, index] : primitives) {
    const model::Primitive& primitive = source.views().meshes[mesh].primitives[index];
    if (primitive.find(model::SemanticKind::texcoord, set) != nullptr) mapped.push_back(&primitive);
  }
  const std::array<std::uint32_t, 1> sets{set};
  model::GeometryRequest request;
  request.tex_coords = sets;
  request.surface = false;
  bool any = false;
  std::size_t first = 0;  // of the points of the last vertices
  bool readable = false;  // likewise
  std::string problem;
  read_primitives(source, mapped, request, budget, [&](const ReadPrimitive& read) {
    if (is_fault(read.error)) {
      problem = "A primitive " + std::string(model::error_text(read.error)) + ".";
      return false;
    }
    auto& points = read.geometry.tex_coords.front();
    if (read.fresh) {
      first = surface.points.size();
      readable = !points.empty();
      if (points.size() > kMostPoints - first) problem = "The material has too many vertices.";
      append(points, surface.points);
    }
    const bool drawn = read.error == model::GeometryError::none;
    if (drawn && !readable) problem = "Texture coordinates could not be read.";
    if (!problem.empty()) return false;
    any = any || drawn;
    for (model::Triangle& triangle : read.geometry.triangles) {
      for (std::uint32_t& corner : triangle) corner += static_cast<std::uint32_t>(first);
    }
    append(read.geometry.triangles, surface.triangles);
    return true;
  });
  if (!problem.empty()) return {problem, true};
  if (any) return {};
  return {primitives.empty() ? "No triangles have the material."
                             : "No primitive has the texture coordinates that the material reads.",
          false};
}

}  // namespace gltfx::measure
