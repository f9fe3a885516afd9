// SPDX-License-Identifier: Apache-2.0
#include "model/vertex_cache.hpp"

#include <meshoptimizer.h>

namespace gltfx::model {

double cache_miss_ratio(std::span<const std::uint32_t> indices, std::size_t vertices) {
  constexpr unsigned kCacheSize = 16;
  if (indices.empty()) return 0;
  return static_cast<double>(
      meshopt_analyzeVertexCache(indices.data(), indices.size(), vertices, kCacheSize, 0, 0).acmr);
}

double fetch_overhead(std::span<const std::uint32_t> indices, std::size_t used,
                      std::uint64_t size) {
  constexpr std::uint64_t kLine = 64, kLines = (std::uint64_t{128} << 10U) / kLine;
  std::vector<std::uint64_t> held(kLines, 0);  // by place, the number of the line and one
  std::uint64_t lines = 0;
  for (const std::uint32_t index : indices) {
    for (std::uint64_t line = index * size / kLine; line * kLine < (index + 1) * size; ++line) {
      std::uint64_t& place = held[line % kLines];
      if (place != line + 1) ++lines;
      place = line + 1;
    }
  }
  if (used == 0) return 0;
  return static_cast<double>(lines * kLine) / static_cast<double>(used * size);
}

std::vector<std::uint32_t> order_for_cache(std::span<const std::uint32_t> indices,
                                           std::size_t vertices) {
  std::vector<std::uint32_t> ordered(indices.size());
  meshopt_optimizeVertexCache(ordered.data(), indices.data(), indices.size(), vertices);
  return ordered;
}

}  // namespace gltfx::model
