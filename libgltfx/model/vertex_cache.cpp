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

std::vector<std::uint32_t> order_for_cache(std::span<const std::uint32_t> indices,
                                           std::size_t vertices) {
  std::vector<std::uint32_t> ordered(indices.size());
  meshopt_optimizeVertexCache(ordered.data(), indices.data(), indices.size(), vertices);
  return ordered;
}

}  // namespace gltfx::model
