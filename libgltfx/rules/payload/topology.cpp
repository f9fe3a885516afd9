// SPDX-License-Identifier: Apache-2.0
#include "rules/payload/topology.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace gltfx::validate {
namespace {

constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();

// Opens elements that are stored in a buffer, which limits the memory for them.
std::optional<model::AccessorData> open_bounded(DataPhase& phase, std::uint32_t accessor) {
  auto data = phase.open(accessor);
  if (!data || data->implied() || data->count() >= kMost) return std::nullopt;
  if (!phase.budget.take(data->count(), data->components())) return std::nullopt;
  return data;
}

template <typename T>
Indices read_as(const model::AccessorData& data) {
  Indices indices;
  indices.reserve(static_cast<std::size_t>(data.count()));
  data.visit<T>([&](const T* values, std::size_t elements, std::uint64_t) {
    indices.insert(indices.end(), values, values + elements);
  });
  return indices;
}

using Position = std::array<float, 3>;

std::optional<std::vector<Position>> read_positions(DataPhase& phase, std::uint32_t accessor) {
  const model::Format& format = phase.context.views.accessors[accessor].format;
  const bool positions =
      format.type == model::ElementType::vec3 && format.component == model::ComponentType::float32;
  if (!positions) return std::nullopt;
  const auto data = open_bounded(phase, accessor);
  if (!data) return std::nullopt;
  std::vector<Position> places;
  places.reserve(static_cast<std::size_t>(data->count()));
  data->visit<float>([&](const float* values, std::size_t elements, std::uint64_t) {
    for (std::size_t i = 0; i < elements; ++i) {
      // NaN has no order; it is replaced by 0, and has been reported.
      Position place{values[i * 3], values[i * 3 + 1], values[i * 3 + 2]};
      for (float& each : place) each = std::isfinite(each) ? each : 0;
      places.push_back(place);
    }
  });
  return places;
}

// The longest side of the bounding box.
float extent_of(const std::vector<Position>& places) {
  float extent = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float least = std::numeric_limits<float>::max();
    float most = std::numeric_limits<float>::lowest();
    for (const Position& each : places) {
      least = std::min(least, each[axis]);
      most = std::max(most, each[axis]);
    }
    extent = std::max(extent, most - least);
  }
  return extent;
}

// Positions in cubes of `reach`: positions that are near enough are in the same cube or an adjacent
// one.
class Grid {
 public:
  Grid(const std::vector<Position>& places, float reach) : places_(places), reach_(reach) {}

  // The vertex that represents those near it: an earlier one, or this one from now on.
  std::uint32_t find_or_add(std::uint32_t vertex) {
    const Cell own = cell_of(vertex);
    for (int step = 0; step < 27; ++step) {
      const Cell beside{own[0] + step % 3 - 1, own[1] + step / 3 % 3 - 1, own[2] + step / 9 - 1};
      const auto found = cells_.find(beside);
      if (found != cells_.end() && is_near(vertex, found->second)) return found->second;
    }
    cells_.try_emplace(own, vertex);
    return vertex;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      std::uint64_t mixed = 0;
      for (const std::int64_t each : cell) {
        mixed = (mixed ^ static_cast<std::uint64_t>(each)) * 0x9E37'79B9'7F4A'7C15U;
        mixed ^= mixed >> 32U;
      }
      return static_cast<std::size_t>(mixed);
    }
  };

  Cell cell_of(std::uint32_t vertex) const {
    Cell cell{};
    for (std::size_t i = 0; i < 3; ++i) {
      cell[i] = static_cast<std::int64_t>(std::floor(places_[vertex][i] / reach_));
    }
    return cell;
  }

  bool is_near(std::uint32_t a, std::uint32_t b) const {
    for (std::size_t i = 0; i < 3; ++i) {
      if (std::abs(places_[a][i] - places_[b][i]) > reach_) return false;
    }
    return true;
  }

  const std::vector<Position>& places_;
  float reach_;
  std::unordered_map<Cell, std::uint32_t, Hash> cells_;
};

}  // namespace

std::optional<Indices> read_indices(DataPhase& phase, std::uint32_t accessor) {
  const model::Format& format = phase.context.views.accessors[accessor].format;
  if (format.type != model::ElementType::scalar || format.normalized) return std::nullopt;
  const auto data = open_bounded(phase, accessor);
  if (!data) return std::nullopt;
  switch (format.component) {
    case model::ComponentType::uint8:
      return read_as<std::uint8_t>(*data);
    case model::ComponentType::uint16:
      return read_as<std::uint16_t>(*data);
    case model::ComponentType::uint32:
      return read_as<std::uint32_t>(*data);
    default:
      return std::nullopt;
  }
}

std::vector<Triangle> triangles_of(model::Mode mode, const Indices& indices) {
  std::vector<Triangle> triangles;
  const std::size_t count = indices.size();
  if (mode == model::Mode::triangles) {
    triangles.reserve(count / 3);
    for (std::size_t i = 0; i + 2 < count; i += 3) {
      triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    }
    return triangles;
  }
  const bool fan = mode == model::Mode::triangle_fan;
  if (!fan && mode != model::Mode::triangle_strip) return triangles;
  for (std::size_t i = 0; i + 2 < count; ++i) {
    if (fan) {
      triangles.push_back({indices[i + 1], indices[i + 2], indices[0]});
    } else {
      triangles.push_back({indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]});
    }
  }
  return triangles;
}

std::optional<std::vector<Triangle>> read_triangles(DataPhase& phase,
                                                    const model::Primitive& primitive) {
  if (!primitive.mode) return std::nullopt;
  if (primitive.indices_node != json::kNoNode) {
    if (!primitive.indices) return std::nullopt;
    const auto indices = read_indices(phase, *primitive.indices);
    return indices ? std::optional(triangles_of(*primitive.mode, *indices)) : std::nullopt;
  }
  const model::Attribute* position = primitive.find(model::SemanticKind::position);
  if (position == nullptr || !position->accessor) return std::nullopt;
  const auto data = open_bounded(phase, *position->accessor);
  if (!data) return std::nullopt;
  Indices all(static_cast<std::size_t>(data->count()));
  std::iota(all.begin(), all.end(), 0U);
  return triangles_of(*primitive.mode, all);
}

std::vector<std::uint64_t> edges_of(const std::vector<Triangle>& triangles) {
  std::vector<std::uint64_t> edges;
  edges.reserve(triangles.size() * 3);
  for (const Triangle& each : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t next = each[(i + 1) % 3];
      if (each[i] != next) edges.push_back(edge_of(each[i], next));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::optional<Indices> first_at_position(DataPhase& phase, std::uint32_t accessor) {
  const auto places = read_positions(phase, accessor);
  if (!places) return std::nullopt;
  Indices order(places->size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return (*places)[a] != (*places)[b] ? (*places)[a] < (*places)[b] : a < b;
  });
  Indices first(places->size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && (*places)[order[i]] == (*places)[order[i - 1]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

std::optional<Indices> first_near_position(DataPhase& phase, std::uint32_t accessor) {
  const auto places = read_positions(phase, accessor);
  if (!places) return std::nullopt;
  constexpr float kRounding = 1.0F / (1U << 18U);
  const float reach = extent_of(*places) * kRounding;
  if (!(reach > 0) || !std::isfinite(reach)) return first_at_position(phase, accessor);
  Grid grid(*places, reach);
  Indices first(places->size());
  for (std::uint32_t i = 0; i < first.size(); ++i) first[i] = grid.find_or_add(i);
  return first;
}

}  // namespace gltfx::validate
