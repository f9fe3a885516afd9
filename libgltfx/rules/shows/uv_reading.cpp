// SPDX-License-Identifier: Apache-2.0
#include "rules/shows/uv_reading.hpp"

#include <algorithm>
#include <utility>

#include "model/elements.hpp"
#include "rules/payload/topology.hpp"

namespace gltfx::validate {
namespace {

// The corners of triangle `i` in the order of indices.
std::array<std::uint64_t, 3> corners_of(model::Mode mode, std::uint64_t i) {
  if (mode == model::Mode::triangles) return {3 * i, 3 * i + 1, 3 * i + 2};
  return {mode == model::Mode::triangle_fan ? 0 : i, i + 1, i + 2};
}

// The pair of an element that exists, without memory of its own.
measure::UvPoint point_at(const model::AccessorData& data, std::uint64_t index) {
  measure::UvPoint point{};
  model::with_component_type(data.format().component, [&](auto zero) {
    using T = decltype(zero);
    std::array<T, 2> values{};
    data.read_one(reinterpret_cast<std::byte*>(values.data()), index);
    for (std::size_t k = 0; k < 2; ++k) {
      point[k] = model::to_float(values[k], data.format().normalized);
    }
  });
  return point;
}

}  // namespace

std::vector<std::vector<PlacedPrimitive>> primitives_of_materials(const Context& context) {
  std::vector<std::vector<PlacedPrimitive>> found(context.asset.count(model::RootArray::materials));
  const auto& meshes = context.views.meshes;
  for (std::uint32_t mesh = 0; mesh < meshes.size(); ++mesh) {
    for (std::uint32_t i = 0; i < meshes[mesh].primitives.size(); ++i) {
      const model::Primitive& primitive = meshes[mesh].primitives[i];
      if (primitive.material) found[*primitive.material].push_back({mesh, i, &primitive});
    }
  }
  return found;
}

std::optional<model::AccessorData> open_uvs(DataPhase& phase, const model::Primitive& primitive,
                                            std::uint64_t set) {
  if (!primitive.mode || !model::draws_triangles(*primitive.mode)) return std::nullopt;
  const model::Attribute* attribute = primitive.find(model::SemanticKind::texcoord, set);
  if (attribute == nullptr || !attribute->accessor) return std::nullopt;
  auto data = phase.open(*attribute->accessor);
  if (!data || data->implied() || data->components() != 2) return std::nullopt;
  return data;
}

UvSample sample_uvs(DataPhase& phase, const model::Primitive& primitive,
                    const model::AccessorData& uvs) {
  constexpr std::uint64_t kFew = 16;
  std::optional<model::AccessorData> indices;
  if (primitive.indices_node != json::kNoNode) {
    if (primitive.indices) indices = phase.open(*primitive.indices);
    if (!indices || indices->implied()) return {};
  }
  const std::uint64_t corners = indices ? indices->count() : uvs.count();
  const bool list = *primitive.mode == model::Mode::triangles;
  UvSample sample;
  sample.of = list ? corners / 3 : corners - std::min<std::uint64_t>(corners, 2);
  sample.triangles.reserve(static_cast<std::size_t>(std::min(kFew, sample.of)));
  for (std::uint64_t n = 0; n < std::min(kFew, sample.of); ++n) {
    // Without an overflow: at most 16 times a count of elements.
    const std::uint64_t i = sample.of <= kFew ? n : sample.of / kFew * n;
    measure::UvTriangle triangle{};
    const auto which = corners_of(*primitive.mode, i);
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint64_t vertex = which[k];
      if (indices) {
        const auto index = model::index_at(*indices, vertex);
        if (!index) return {};
        vertex = *index;
      }
      if (vertex >= uvs.count()) return {};
      triangle[k] = point_at(uvs, vertex);
    }
    sample.triangles.push_back(triangle);
  }
  return sample;
}

std::optional<measure::UvSurface> read_uvs(DataPhase& phase, const model::Primitive& primitive,
                                           const model::AccessorData& uvs) {
  auto triangles = read_triangles(phase, primitive);
  if (!triangles || uvs.count() > UINT32_MAX || !phase.budget.take(uvs.count(), 2)) {
    return std::nullopt;
  }
  measure::UvSurface surface;
  surface.points.resize(static_cast<std::size_t>(uvs.count()));
  model::read_elements(uvs, surface.points);
  surface.triangles = *std::move(triangles);
  std::erase_if(surface.triangles, [&](const model::Triangle& each) {
    return std::any_of(each.begin(), each.end(),
                       [&](std::uint32_t corner) { return corner >= surface.points.size(); });
  });
  return surface;
}

}  // namespace gltfx::validate
