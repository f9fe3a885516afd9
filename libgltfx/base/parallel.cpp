// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.hpp"

#include <algorithm>

#include <tbb/info.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

namespace gltfx {
namespace {

constexpr std::size_t kAheadPerJob = 4;  // enough that one slow item does not idle the others

void run_pipeline(std::size_t count, std::size_t ahead,
                  const std::function<void(std::size_t)>& produce,
                  const std::function<void(std::size_t)>& consume) {
  std::size_t next = 0;
  const auto number = [&next, count](tbb::flow_control& control) -> std::size_t {
    if (next == count) {
      control.stop();
      return 0;
    }
    return next++;
  };
  const auto work = [&produce](std::size_t i) {
    produce(i);
    return i;
  };
  tbb::parallel_pipeline(
      ahead, tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, number) &
                 tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel, work) &
                 tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order, consume));
}

// TBB has no more workers than that, and says so on stderr when asked for more.
unsigned possible_jobs(unsigned jobs) {
  return jobs == 1 ? 1 : std::min(jobs == 0 ? default_jobs() : jobs, default_jobs());
}

}  // namespace

unsigned default_jobs() {
  return static_cast<unsigned>(std::max(1, tbb::info::default_concurrency()));
}

void parallel_ordered(std::size_t count, unsigned jobs,
                      const std::function<void(std::size_t)>& produce,
                      const std::function<void(std::size_t)>& consume) {
  jobs = possible_jobs(jobs);
  if (jobs == 1 || count < 2) {
    for (std::size_t i = 0; i < count; ++i) {
      produce(i);
      consume(i);
    }
    return;
  }
  tbb::task_arena arena(static_cast<int>(jobs));
  arena.execute([&] { run_pipeline(count, jobs * kAheadPerJob, produce, consume); });
}

void run_both(unsigned jobs, const std::function<void()>& one, const std::function<void()>& other) {
  jobs = possible_jobs(jobs);
  if (jobs == 1) {
    one();
    other();
    return;
  }
  tbb::task_arena arena(static_cast<int>(jobs));
  arena.execute([&] { tbb::parallel_invoke(one, other); });
}

}  // namespace gltfx
