// SPDX-License-Identifier: Apache-2.0
/// Checks that two threads run.
#pragma once

#include <atomic>
#include <chrono>
#include <latch>
#include <thread>

#include "base/parallel.hpp"

namespace gltfx::test {

/// Runs two items of which each waits for the other, which both succeed only if two threads are at
/// work; however busy the machine is, the second one has its turn within ten minutes.
inline bool two_run_at_once() {
  std::latch both(2);
  std::atomic<int> met = 0;
  const auto meet = [&](std::size_t) {
    constexpr std::chrono::minutes kTooLong(10);
    const auto begin = std::chrono::steady_clock::now();
    both.count_down();
    while (!both.try_wait() && std::chrono::steady_clock::now() - begin < kTooLong) {
      std::this_thread::yield();
    }
    if (both.try_wait()) ++met;
  };
  parallel_ordered(2, 2, meet, [](std::size_t) {});
  return met == 2;
}

}  // namespace gltfx::test
