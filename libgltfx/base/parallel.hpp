// SPDX-License-Identifier: Apache-2.0
/// Work on several threads, results in the order of the items.
#pragma once

#include <cstddef>
#include <functional>

namespace gltfx {

/// Number of processors that this process may use; at least 1.
unsigned default_jobs();

/// Calls produce(i) for every i in [0, count), on up to `jobs` threads at once, and consume(i)
/// strictly in the order 0, 1, 2, ..., one call at a time, each after its produce(i). Returns when
/// all are consumed.
///
/// - `jobs` 1 runs everything on the caller's thread, item by item; 0 and more than default_jobs()
///   mean default_jobs().
/// - Items that are produced and not yet consumed never exceed a small multiple of `jobs`, so that
///   memory does not grow with the number of items.
/// - consume() may run on any of the threads, but all writes of earlier calls are visible to it.
/// - Callbacks must not throw. If one throws, the work ends early and the exception reaches the
///   caller of parallel_ordered.
void parallel_ordered(std::size_t count, unsigned jobs,
                      const std::function<void(std::size_t)>& produce,
                      const std::function<void(std::size_t)>& consume);

/// Calls both, at the same time when `jobs` (as above) is not 1, and returns when both are done.
/// An exception reaches the caller.
void run_both(unsigned jobs, const std::function<void()>& one, const std::function<void()>& other);

}  // namespace gltfx
