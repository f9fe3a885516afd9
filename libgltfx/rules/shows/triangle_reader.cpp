// SPDX-License-Identifier: Apache-2.0
#include "rules/shows/triangle_reader.hpp"

#include <algorithm>
#include <type_traits>

#include "model/elements.hpp"

namespace gltfx::validate {

using model::AccessorData;
using model::Mode;

std::optional<TriangleReader> TriangleReader::open(const DataPhase& phase,
                                                   const model::Primitive& primitive) {
  if (!primitive.mode || !model::draws_triangles(*primitive.mode)) return std::nullopt;
  const auto elements = [&](model::SemanticKind kind) -> std::optional<AccessorData> {
    const model::Attribute* found = primitive.find(kind);
    if (found == nullptr || !found->accessor) return std::nullopt;
    auto data = phase.open(*found->accessor);
    if (!data || data->implied() || data->components() != 3) return std::nullopt;
    return data;
  };
  auto positions = elements(model::SemanticKind::position);
  if (!positions) return std::nullopt;
  TriangleReader reader(*primitive.mode, *std::move(positions));
  if (primitive.indices_node != json::kNoNode) {
    if (!primitive.indices) return std::nullopt;
    reader.indices_ = phase.open(*primitive.indices);
    if (!reader.indices_ || reader.indices_->implied() || reader.indices_->components() != 1) {
      return std::nullopt;
    }
    reader.plain_ = phase.context.views.accessors[*primitive.indices].sparse == json::kNoNode;
  }
  reader.normals_ = elements(model::SemanticKind::normal);
  if (reader.normals_ && reader.normals_->count() != reader.positions_.count()) {
    reader.normals_.reset();
  }
  return reader;
}

std::uint64_t TriangleReader::count() const {
  const std::uint64_t corners = corner_count();
  if (mode_ == Mode::triangles) return corners / 3;
  return corners < 3 ? 0 : corners - 2;
}

std::optional<std::array<std::uint32_t, 3>> TriangleReader::corners(std::uint64_t i) const {
  std::array<std::uint64_t, 3> vertices{};
  if (mode_ == Mode::triangles) {
    vertices = indices_of_list(i);
  } else if (mode_ == Mode::triangle_fan) {
    vertices = {index(i + 1), index(i + 2), index(0)};
  } else {
    vertices = {index(i), index(i + 1 + i % 2), index(i + 2 - i % 2)};
  }
  std::array<std::uint32_t, 3> corners{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (vertices[k] >= positions_.count()) return std::nullopt;
    corners[k] = static_cast<std::uint32_t>(vertices[k]);
  }
  return corners;
}

std::array<std::uint64_t, 3> TriangleReader::indices_of_list(std::uint64_t triangle) const {
  std::array<std::uint64_t, 3> found{3 * triangle, 3 * triangle + 1, 3 * triangle + 2};
  if (!indices_) return found;
  if (!plain_) return {index(found[0]), index(found[1]), index(found[2])};
  model::with_component_type(indices_->format().component, [&](auto zero) {
    using T = decltype(zero);
    if constexpr (std::is_unsigned_v<T>) {
      std::array<T, 3> values{};
      std::uint64_t next = 0;
      indices_->read(reinterpret_cast<std::byte*>(values.data()), 3 * triangle, 3, next);
      std::copy(values.begin(), values.end(), found.begin());
    }
  });
  return found;
}

std::uint64_t TriangleReader::index(std::uint64_t corner) const {
  return indices_ ? model::index_at(*indices_, corner).value_or(0) : corner;
}

Float3 TriangleReader::read(const AccessorData& data, std::uint32_t vertex) {
  Float3 element{};
  if (data.format().component == model::ComponentType::float32) {
    data.read_one(reinterpret_cast<std::byte*>(element.data()), vertex);
    return element;
  }
  model::with_component_type(data.format().component, [&](auto zero) {
    using T = decltype(zero);
    std::array<T, 4> values{};
    data.read_one(reinterpret_cast<std::byte*>(values.data()), vertex);
    for (std::size_t k = 0; k < 3; ++k) {
      element[k] = model::to_float(values[k], data.format().normalized);
    }
  });
  return element;
}

}  // namespace gltfx::validate
