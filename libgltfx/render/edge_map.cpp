// SPDX-License-Identifier: Apache-2.0
#include "render/edge_map.hpp"

#include <optional>
#include <span>

#include "render/camera_packet.hpp"

namespace gltfx::render {
namespace {

constexpr std::uint64_t kNothing = ~std::uint64_t{0};

}  // namespace

EdgeMap::EdgeMap(const Bvh& bvh, const View& view, const RenderOptions& options, std::uint32_t left,
                 std::uint32_t top)
    : left_(left), top_(top) {
  const auto fill = [&](std::uint32_t place, std::span<CameraSample> samples) {
    for (CameraSample& sample : samples) {
      const std::uint32_t column = place % kColumns;
      const std::uint32_t row = place / kColumns;
      sample.ray = view.ray((left + static_cast<double>(column) - 0.5) / options.width,
                            (top + static_cast<double>(row) - 0.5) / options.height);
      ++place;
    }
  };
  auto* body = bodies_.data();
  visit_camera_samples(bvh, 0, kColumns * kRows, fill,
                       [&](const CameraSample& /*sample*/, const std::optional<Hit>& hit) {
                         *body++ = hit ? hit->body() : kNothing;
                       });
}

bool EdgeMap::is_near_edge(std::uint32_t x, std::uint32_t y) const {
  const auto* row = &bodies_[std::size_t{y - top_} * kColumns + (x - left_)];
  const std::uint64_t body = *row;
  for (int i = 0; i < 3; ++i, row += kColumns) {
    if (row[0] != body || row[1] != body || row[2] != body) return true;
  }
  return false;
}

}  // namespace gltfx::render
