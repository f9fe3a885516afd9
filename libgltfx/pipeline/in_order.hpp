// SPDX-License-Identifier: Apache-2.0
/// Reports on many files, in their order, whatever memory there is.
#pragma once

#include <cstddef>
#include <functional>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "base/parallel.hpp"

namespace gltfx {

/// Calls produce(i), which must not throw, for every i below `count` on up to `jobs` threads, and
/// consume(report) in their order, one call at a time. Where memory for the threads is missing, the
/// rest is done one by one. What consume() throws reaches the caller.
template <class Report, class Produce>
void report_in_order(std::size_t count, unsigned jobs, const Produce& produce,
                     const std::function<void(Report&&)>& consume) {
  std::size_t next = 0;
  bool consuming = false;
  const auto hand_over = [&](Report&& report) {
    ++next;
    consuming = true;
    consume(std::move(report));
    consuming = false;
  };
  try {
    std::vector<std::optional<Report>> reports(count);
    parallel_ordered(
        count, jobs, [&](std::size_t i) { reports[i] = produce(i); },
        [&](std::size_t i) {
          hand_over(std::move(*reports[i]));
          reports[i].reset();
        });
  } catch (const std::bad_alloc&) {
    if (consuming) throw;
    while (next < count) hand_over(produce(next));
  }
}

}  // namespace gltfx
