// SPDX-License-Identifier: Apache-2.0
/// Four numbers that are computed together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace gltfx {

inline constexpr std::size_t kLanes = 4;
using Lanes [[gnu::vector_size(16)]] = float;
using IntLanes [[gnu::vector_size(16)]] = std::int32_t;
using UintLanes [[gnu::vector_size(16)]] = std::uint32_t;

inline Lanes load_lanes(const float* values) {
  Lanes lanes;
  std::memcpy(&lanes, values, sizeof(lanes));
  return lanes;
}

inline void store_lanes(const Lanes& lanes, float* values) {
  std::memcpy(values, &lanes, sizeof(lanes));
}

inline float sum_of(const Lanes& lanes) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); }

}  // namespace gltfx
