// SPDX-License-Identifier: Apache-2.0
#include "measure/uv_surface.hpp"

#include <array>
#include <limits>

#include "base/checked.hpp"

namespace gltfx::measure {

// A triangle takes about one byte in the most compact form, and 50 in memory.
model::MemoryBudget reading_budget(const Source& source) {
  constexpr std::uint64_t kWorth = 64;
  std::uint64_t bytes = std::uint64_t{1} << 28U;
  for (const auto& buffer : source.resources().buffers) {
    if (!buffer) continue;
    bytes = saturating_add(bytes, checked_mul(kWorth, buffer->size()).value_or(UINT64_MAX));
  }
  return model::MemoryBudget(bytes);
}

std::vector<std::vector<MeasuredPrimitive>> primitives_by_material(const Taking& taking) {
  std::vector<std::vector<MeasuredPrimitive>> uses(taking.count(MeasureScope::material));
  const auto& meshes = taking.source().views().meshes;
  for (std::uint32_t mesh = 0; mesh < meshes.size(); ++mesh) {
    for (std::uint32_t i = 0; i < meshes[mesh].primitives.size(); ++i) {
      const model::Primitive& primitive = meshes[mesh].primitives[i];
      if (!primitive.mode || !model::draws_triangles(*primitive.mode)) continue;
      const std::size_t material =
          primitive.material ? *primitive.material : taking.plain_material();
      uses[material].push_back({mesh, i});
    }
  }
  return uses;
}

UvProblem read_uv_surface(const Source& source, std::span<const MeasuredPrimitive> primitives,
                          std::uint32_t set, model::MemoryBudget& budget, UvSurface& surface) {
  bool any = false;
  for (const auto& [mesh, index] : primitives) {
    const model::Primitive& primitive = source.views().meshes[mesh].primitives[index];
    if (primitive.find(model::SemanticKind::texcoord, set) == nullptr) continue;
    const std::array<std::uint32_t, 1> sets{set};
    model::GeometryRequest request;
    request.tex_coords = sets;
    request.surface = false;
    model::Geometry geometry;
    const auto error =
        model::read_geometry(source.geometry(), primitive, request, budget, geometry);
    if (error == model::GeometryError::empty) continue;
    if (error != model::GeometryError::none) {
      return {"A primitive " + std::string(model::error_text(error)) + ".", true};
    }
    if (geometry.tex_coords.front().empty())
      return {"Texture coordinates could not be read.", true};
    any = true;
    const auto first = static_cast<std::uint32_t>(surface.points.size());
    if (geometry.tex_coords.front().size() >
        std::numeric_limits<std::uint32_t>::max() / 4 - first) {
      return {"The material has too many vertices.", true};
    }
    if (first == 0) {
      surface = {std::move(geometry.tex_coords.front()), std::move(geometry.triangles)};
      continue;
    }
    surface.points.insert(surface.points.end(), geometry.tex_coords.front().begin(),
                          geometry.tex_coords.front().end());
    for (model::Triangle triangle : geometry.triangles) {
      for (std::uint32_t& corner : triangle) corner += first;
      surface.triangles.push_back(triangle);
    }
  }
  if (any) return {};
  return {primitives.empty() ? "No triangles have the material."
                             : "No primitive has the texture coordinates that the material reads.",
          false};
}

}  // namespace gltfx::measure
