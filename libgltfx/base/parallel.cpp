// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.hpp"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <sched.h>

#include "base/fork.hpp"

namespace gltfx {
namespace {

constexpr std::size_t kAheadPerJob = 4;  // enough that one slow item does not idle the others

using Work = std::function<void(std::size_t)>;

/// One call of parallel_ordered(). The mutex of the pool guards it.
struct Call {
  Call(std::size_t n, unsigned limit, const Work& first, const Work& second)
      : count(n), jobs(limit), produce(first), consume(second), ready(limit * kAheadPerJob) {}

  bool has_item() const {
    return failure == nullptr && taken < count && taken - consumed < ready.size();
  }
  bool is_done() const { return helpers == 0 && (failure != nullptr || consumed == count); }

  const std::size_t count;
  const unsigned jobs;
  const Work& produce;
  const Work& consume;
  std::vector<bool> ready;  // by item, modulo the size
  std::size_t taken = 0, consumed = 0;
  bool consuming = false;
  unsigned helpers = 0;  // threads besides the caller's
  std::exception_ptr failure;
  std::condition_variable changed;  // the caller waits for it
  Call* older = nullptr;
};

/// Threads that help with any call that has items to take. A caller works on its own call and waits
/// for items that others have taken, never for a thread to become free: calls may be nested.
class ThreadPool {
 public:
  static ThreadPool& of_process() {
    static constinit PerProcess<ThreadPool> pool;  // its threads run as long as the process
    return pool.get();
  }

  void run(Call& call) {
    std::unique_lock lock(mutex_);
    call.older = std::exchange(newest_, &call);
    wake(std::min<std::size_t>(call.count, call.jobs) - 1);
    while (!call.is_done()) {
      if (call.has_item()) {
        work_on(call, lock);
      } else {
        call.changed.wait(lock);
      }
    }
    Call** link = &newest_;
    while (*link != &call) link = &(*link)->older;
    *link = call.older;
  }

 private:
  void wake(std::size_t wanted) {
    for (; wanted > 0 && idle_ > 0; --wanted) {
      --idle_;
      ++called_;
      wanted_.notify_one();
    }
    try {
      for (; wanted > 0 && threads_ + 1 < default_jobs(); --wanted) {
        std::thread([this] { help(); }).detach();
        ++threads_;
      }
    } catch (const std::exception&) {  // fewer threads are enough
    }
  }

  void help() {
    std::unique_lock lock(mutex_);
    while (true) {
      Call* call = newest_;
      while (call != nullptr && !(call->has_item() && call->helpers + 1 < call->jobs)) {
        call = call->older;
      }
      if (call == nullptr) {
        ++idle_;
        wanted_.wait(lock, [this] { return called_ > 0; });
        --called_;
        continue;
      }
      ++call->helpers;
      while (call->has_item()) work_on(*call, lock);
      --call->helpers;
      call->changed.notify_one();
    }
  }

  // Takes one item. Consumes the items that are ready unless another thread does.
  void work_on(Call& call, std::unique_lock<std::mutex>& lock) {
    const std::size_t item = call.taken++;
    run_unlocked(call, call.produce, item, lock);
    call.ready[item % call.ready.size()] = true;
    while (call.failure == nullptr && !call.consuming &&
           call.ready[call.consumed % call.ready.size()]) {
      call.consuming = true;
      run_unlocked(call, call.consume, call.consumed, lock);
      call.consuming = false;
      call.ready[call.consumed % call.ready.size()] = false;
      ++call.consumed;
      if (!call.has_item()) continue;
      call.changed.notify_one();
      if (call.helpers + 1 < call.jobs) wake(1);
    }
  }

  static void run_unlocked(Call& call, const Work& work, std::size_t item,
                           std::unique_lock<std::mutex>& lock) {
    lock.unlock();
    std::exception_ptr failure;
    try {
      work(item);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure != nullptr && call.failure == nullptr) call.failure = std::move(failure);
  }

  std::mutex mutex_;
  std::condition_variable wanted_;
  Call* newest_ = nullptr;
  std::size_t threads_ = 0, idle_ = 0, called_ = 0;
};

unsigned possible_jobs(unsigned jobs) {
  return jobs == 1 ? 1 : std::min(jobs == 0 ? default_jobs() : jobs, default_jobs());
}

unsigned processors() {
#ifdef __EMSCRIPTEN__
  return 1;  // WebAssembly without threads
#else
  cpu_set_t usable;  // the call fails on machines with more processors
  const int count = ::sched_getaffinity(0, sizeof usable, &usable) == 0 ? CPU_COUNT(&usable) : 0;
  return count > 0 ? static_cast<unsigned>(count)
                   : std::max(1U, std::thread::hardware_concurrency());
#endif
}

}  // namespace

unsigned default_jobs() {
  static constinit MadeOnce<unsigned> jobs;
  return jobs.get(processors);
}

void parallel_ordered(std::size_t count, unsigned jobs, const Work& produce, const Work& consume) {
  jobs = possible_jobs(jobs);
  if (jobs == 1 || count < 2) {
    for (std::size_t i = 0; i < count; ++i) {
      produce(i);
      consume(i);
    }
    return;
  }
  Call call(count, jobs, produce, consume);
  ThreadPool::of_process().run(call);
  if (call.failure != nullptr) std::rethrow_exception(call.failure);
}

void run_both(unsigned jobs, const std::function<void()>& one, const std::function<void()>& other) {
  parallel_ordered(
      2, jobs, [&](std::size_t i) { i == 0 ? one() : other(); }, [](std::size_t) {});
}

}  // namespace gltfx
