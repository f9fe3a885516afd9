// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include <tbb/info.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#ifdef GLTFX_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace gltfx {
namespace {

constexpr std::size_t kAheadPerJob = 4;  // enough that one slow item does not idle the others

/// What one thread leaves to another through TBB. It orders nothing: it says that TBB does. Nothing
/// at all but for ThreadSanitizer, which cannot look into the library and would take what is
/// written before give() and read after take() for a race.
class HandOver {
 public:
  void give() {
#ifdef GLTFX_THREAD_SANITIZER
    __tsan_release(this);
#endif
  }
  void take() {
#ifdef GLTFX_THREAD_SANITIZER
    __tsan_acquire(this);
#endif
  }
};

// An item is made after the one that was `ahead` items before it was taken, and taken after all
// before it were.
void run_pipeline(std::size_t count, std::size_t ahead,
                  const std::function<void(std::size_t)>& produce,
                  const std::function<void(std::size_t)>& consume) {
  HandOver begin, order;
  std::vector<HandOver> items(ahead);
  std::size_t next = 0;
  const auto number = [&](tbb::flow_control& control) -> std::size_t {
    begin.take();
    const std::size_t i = next;
    if (i == count) {
      control.stop();
    } else {
      ++next;
    }
    begin.give();
    return i;
  };
  const auto work = [&](std::size_t i) {
    begin.take();
    items[i % ahead].take();
    produce(i);
    items[i % ahead].give();
    return i;
  };
  const auto end = [&](std::size_t i) {
    items[i % ahead].take();
    order.take();
    consume(i);
    items[i % ahead].give();
    order.give();
  };
  begin.give();
  tbb::parallel_pipeline(
      ahead, tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, number) &
                 tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel, work) &
                 tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order, end));
  begin.take();
  order.take();
}

// Where TBB's workers meet for as long as it lives. It is slow to give back what an arena has held,
// megabytes after some dozens of them, so each is used again once it is free.
class Arena {
 public:
  explicit Arena(unsigned jobs) {
    const std::lock_guard lock(mutex());
    arena_ = idle().extract(jobs);
    if (arena_.empty()) {
      Arenas made;
      arena_ = made.extract(made.emplace(jobs, static_cast<int>(jobs)));
    }
  }
  ~Arena() {
    const std::lock_guard lock(mutex());
    idle().insert(idle().lower_bound(arena_.key()), std::move(arena_));  // the warm one first
  }
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  template <class Work>
  void execute(const Work& work) {
    arena_.mapped().execute(work);
  }

 private:
  using Arenas = std::multimap<unsigned, tbb::task_arena>;  // by jobs

  static std::mutex& mutex() {
    static std::mutex mutex;
    return mutex;
  }
  static Arenas& idle() {
    static Arenas& idle = *new Arenas;  // for as long as anything runs
    return idle;
  }

  Arenas::node_type arena_;
};

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
  Arena arena(jobs);
  arena.execute([&] { run_pipeline(count, jobs * kAheadPerJob, produce, consume); });
}

void run_both(unsigned jobs, const std::function<void()>& one, const std::function<void()>& other) {
  jobs = possible_jobs(jobs);
  if (jobs == 1) {
    one();
    other();
    return;
  }
  HandOver begin, end;
  const auto between = [&](const std::function<void()>& work) {
    begin.take();
    work();
    end.give();
  };
  begin.give();
  Arena arena(jobs);
  arena.execute([&] { tbb::parallel_invoke([&] { between(one); }, [&] { between(other); }); });
  end.take();
}

void run_alone(const std::function<void()>& work) {
  Arena arena(1);
  arena.execute(work);
}

}  // namespace gltfx
