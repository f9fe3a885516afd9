// SPDX-License-Identifier: Apache-2.0
/// Estimates which patterns of UASTC suit a block.
#pragma once

#include <cstdint>
#include <vector>

#include "uastc_line.hpp"

namespace gltfx::codec {

struct RankedPattern {
  std::uint8_t mode = 0;   ///< that has the pattern: 2, 3 or 7
  std::uint8_t index = 0;  ///< in uastc_patterns()
  float distance = 0;      ///< sum of squared distances from the axes of the subsets
};

/// The patterns with a distance below `limit`, the smallest first. `channels`: 3, or 4 with alpha,
/// for which there are only the patterns of mode 2.
std::vector<RankedPattern> rank_patterns(const BlockLanes& block, std::uint8_t channels,
                                         float limit);

}  // namespace gltfx::codec
