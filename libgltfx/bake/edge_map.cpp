// SPDX-License-Identifier: Apache-2.0
#include "bake/edge_map.hpp"

#include <algorithm>
#include <optional>
#include <span>

namespace gltfx::bake {
namespace {

constexpr std::uint64_t kNothing = ~std::uint64_t{0};

}  // namespace

EdgeMap::EdgeMap(const Bvh& bvh, const View& view, const RenderOptions& options, std::uint32_t left,
                 std::uint32_t top)
    : left_(left), top_(top) {
  const auto ray_of = [&](std::size_t place) {
    const std::size_t column = place % kColumns;
    const std::size_t row = place / kColumns;
    return view.ray((left + static_cast<double>(column) - 0.5) / options.width,
                    (top + static_cast<double>(row) - 0.5) / options.height);
  };
  std::array<Ray, Bvh::kCameraPacket> rays;
  std::array<std::optional<Hit>, Bvh::kCameraPacket> hits;
  for (std::size_t first = 0; first < bodies_.size(); first += rays.size()) {
    const std::size_t count = std::min(rays.size(), bodies_.size() - first);
    for (std::size_t i = 0; i < count; ++i) rays[i] = ray_of(first + i);
    bvh.first_layers(std::span(rays).first(count), hits);
    for (std::size_t i = 0; i < count; ++i)
      bodies_[first + i] = hits[i] ? hits[i]->body() : kNothing;
  }
}

bool EdgeMap::is_near_edge(std::uint32_t x, std::uint32_t y) const {
  const auto* row = &bodies_[std::size_t{y - top_} * kColumns + (x - left_)];
  const std::uint64_t body = *row;
  for (int i = 0; i < 3; ++i, row += kColumns) {
    if (row[0] != body || row[1] != body || row[2] != body) return true;
  }
  return false;
}

}  // namespace gltfx::bake
