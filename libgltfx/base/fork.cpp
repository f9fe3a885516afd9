// SPDX-License-Identifier: Apache-2.0
#include "base/fork.hpp"

#include <new>
#include <set>

#include <pthread.h>
#include <unistd.h>

namespace gltfx {
namespace {

std::atomic<std::uint64_t> generation{0};

}  // namespace

/// All watchers, and the functions that the system calls around a fork().
class ForkWatchers {
 public:
  void add(ForkWatcher& watcher) {
    const std::lock_guard lock(mutex_);
    watcher.older_ = newest_;
    if (newest_ != nullptr) newest_->newer_ = &watcher;
    newest_ = &watcher;
  }
  void remove(ForkWatcher& watcher) {
    const std::lock_guard lock(mutex_);
    (watcher.newer_ != nullptr ? watcher.newer_->older_ : newest_) = watcher.older_;
    if (watcher.older_ != nullptr) watcher.older_->newer_ = watcher.newer_;
  }

  void before_fork() noexcept {
    mutex_.lock();
    for (ForkWatcher* at = newest_; at != nullptr; at = at->older_) at->before_fork();
  }
  void after_fork(bool in_child) noexcept {
    for (ForkWatcher* at = newest_; at != nullptr; at = at->older_) at->after_fork(in_child);
    mutex_.unlock();
  }

 private:
  std::mutex mutex_;
  ForkWatcher* newest_ = nullptr;
};

namespace {

constinit ForkWatchers watchers;

/// Descriptors that are closed in a child.
class Descriptors final : public ForkWatcher {
 public:
  void lock() { mutex_.lock(); }
  void unlock() { mutex_.unlock(); }
  // Precondition of both: locked.
  void insert(int fd) { numbers_.insert(fd); }
  void erase(int fd) { numbers_.erase(fd); }

  void before_fork() noexcept override { mutex_.lock(); }
  void after_fork(bool in_child) noexcept override {
    if (in_child) {
      for (const int fd : numbers_) ::close(fd);
      numbers_.clear();
    }
    mutex_.unlock();
  }

 private:
  std::mutex mutex_;
  std::set<int> numbers_;
};

// Never destroyed: descriptors may be closed last.
Descriptors& descriptors() {
  static auto* const kept = new Descriptors;  // NOLINT(cppcoreguidelines-owning-memory)
  return *kept;
}

#ifndef __EMSCRIPTEN__  // which has no processes
// Runs when the library is loaded: it has no threads yet, and its local static is made.
[[maybe_unused]] const bool watched = [] {
  descriptors();
  return ::pthread_atfork([] { watchers.before_fork(); }, [] { watchers.after_fork(false); },
                          [] {
                            ++generation;
                            watchers.after_fork(true);
                          }) == 0;
}();
#endif

}  // namespace

std::uint64_t fork_generation() noexcept { return generation.load(std::memory_order_relaxed); }

ForkWatcher::ForkWatcher() { watchers.add(*this); }
ForkWatcher::~ForkWatcher() { watchers.remove(*this); }

void ForkGate::lock_shared() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !closed_; });
  ++inside_;
}

void ForkGate::unlock_shared() {
  const std::lock_guard lock(mutex_);
  if (--inside_ == 0) changed_.notify_all();
}

void ForkGate::before_fork() noexcept {
  std::unique_lock lock(mutex_);
  closed_ = true;
  changed_.wait(lock, [this] { return inside_ == 0; });
  lock.release();
}

void ForkGate::after_fork(bool in_child) noexcept {
  closed_ = false;
  // Waiting threads do not exist in the child, where a notification could go to them.
  if (in_child) ::new (&changed_) std::condition_variable;
  changed_.notify_all();
  mutex_.unlock();
}

OwnDescriptor::~OwnDescriptor() {
  if (!fd_) return;
  const NoFork now;
  descriptors().erase(fd_.get());
  const UniqueFd last = std::move(fd_);
}

NoFork::NoFork() { descriptors().lock(); }
NoFork::~NoFork() { descriptors().unlock(); }

OwnDescriptor NoFork::own(int fd) const {
  UniqueFd kept(fd);
  if (fd >= 0) descriptors().insert(fd);
  return OwnDescriptor(std::move(kept));
}

}  // namespace gltfx
