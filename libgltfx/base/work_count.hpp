// SPDX-License-Identifier: Apache-2.0
/// How often costly steps were taken, so that tests see when one is repeated.
#pragma once

#include <atomic>
#include <cstdint>

namespace gltfx {

/// Since the process began, by all of its threads.
struct WorkCount {
  std::atomic<std::uint64_t> opened{0};     ///< files of assets
  std::atomic<std::uint64_t> parsed{0};     ///< JSON texts but for those that are copied for it
  std::atomic<std::uint64_t> validated{0};  ///< assets
};

inline WorkCount work_count;

}  // namespace gltfx
