// SPDX-License-Identifier: Apache-2.0
/// Counts costly steps, so that tests find repeated ones.
#pragma once

#include <atomic>
#include <cstdint>

namespace gltfx {

/// Steps since the process began, by all of its threads.
struct WorkCount {
  std::atomic<std::uint64_t> opened{0};     ///< files of assets
  std::atomic<std::uint64_t> parsed{0};     ///< JSON texts except those that the parser copies
  std::atomic<std::uint64_t> validated{0};  ///< assets
  std::atomic<std::uint64_t> decoded{0};    ///< images, by decoder programs
};

inline WorkCount work_count;

}  // namespace gltfx
