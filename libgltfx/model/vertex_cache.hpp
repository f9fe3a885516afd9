// SPDX-License-Identifier: Apache-2.0
/// Orders of triangles and vertices for the caches of a GPU.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gltfx::model {

/// Vertices that a cache of 16 shades per triangle: from 0.5 to 3. 0 without triangles.
/// Precondition: three indices a triangle, each below `vertices`.
double cache_miss_ratio(std::span<const std::uint32_t> indices, std::size_t vertices);

/// Bytes of the cache lines that are read, over the bytes of the vertices that are used: 1 or more.
/// Vertices have `size` bytes, one behind the other; the cache holds 128 KiB in lines of 64 bytes,
/// each in one place by its address. 0 without indices. `used`: the number of distinct indices.
double fetch_overhead(std::span<const std::uint32_t> indices, std::size_t used, std::uint64_t size);

/// The same triangles in an order with fewer misses, by meshoptimizer; each keeps its first corner.
/// The result does not depend on the machine. Precondition: as above.
std::vector<std::uint32_t> order_for_cache(std::span<const std::uint32_t> indices,
                                           std::size_t vertices);

}  // namespace gltfx::model
