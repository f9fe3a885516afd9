// SPDX-License-Identifier: Apache-2.0
/// Support for a process that forks while its threads work. Only the thread that calls fork()
/// exists in the child: mutexes that other threads had locked stay locked there, their unfinished
/// work is never finished, and pools have no threads.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>

#include "base/unique_fd.hpp"

namespace gltfx {

/// Another number in each child of a fork().
std::uint64_t fork_generation() noexcept;

/// Called at each fork() by the thread that forks, the newest watcher first.
class ForkWatcher {
 public:
  ForkWatcher();
  ForkWatcher(const ForkWatcher&) = delete;
  ForkWatcher& operator=(const ForkWatcher&) = delete;
  virtual void before_fork() noexcept = 0;
  virtual void after_fork(bool in_child) noexcept = 0;

 protected:
  ~ForkWatcher();

 private:
  friend class ForkWatchers;
  ForkWatcher* newer_ = nullptr;
  ForkWatcher* older_ = nullptr;
};

/// A mutex that no other thread holds when the process forks. Hold it for short times only, and
/// lock no other ForkMutex while it is held.
class ForkMutex final : public ForkWatcher {
 public:
  void lock() { mutex_.lock(); }
  bool try_lock() { return mutex_.try_lock(); }
  void unlock() { mutex_.unlock(); }
  void before_fork() noexcept override { mutex_.lock(); }
  void after_fork(bool) noexcept override { mutex_.unlock(); }

 private:
  std::mutex mutex_;
};

/// For std::shared_lock, around calls of libraries that do not expect a fork. Any number of threads
/// may hold it, but none when the process forks.
class ForkGate final : public ForkWatcher {
 public:
  void lock_shared();
  void unlock_shared();
  void before_fork() noexcept override;
  void after_fork(bool in_child) noexcept override;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  unsigned inside_ = 0;
  bool closed_ = false;
};

/// A descriptor that is closed in the child of a fork(): a copy there would keep the peer waiting.
class OwnDescriptor {
 public:
  OwnDescriptor() = default;
  OwnDescriptor(OwnDescriptor&&) noexcept = default;
  OwnDescriptor& operator=(OwnDescriptor&&) noexcept = default;
  OwnDescriptor(const OwnDescriptor&) = delete;
  OwnDescriptor& operator=(const OwnDescriptor&) = delete;
  ~OwnDescriptor();

  int get() const { return fd_.get(); }
  explicit operator bool() const { return static_cast<bool>(fd_); }

 private:
  friend class NoFork;
  explicit OwnDescriptor(UniqueFd fd) : fd_(std::move(fd)) {}

  UniqueFd fd_;
};

/// Prevents a fork during its lifetime: from opening descriptors until they have an owner.
class NoFork {
 public:
  NoFork();
  ~NoFork();
  NoFork(const NoFork&) = delete;
  NoFork& operator=(const NoFork&) = delete;

  /// Takes over a descriptor; -1 is none.
  OwnDescriptor own(int fd) const;
};

/// One object per process, made at first use: the child of a fork() makes its own and leaves that
/// of its parent alone. Thread-safe.
template <class T>
class PerProcess {
 public:
  T& get() {
    Entry* entry = newest_.load(std::memory_order_acquire);
    const std::uint64_t generation = fork_generation();
    if (entry != nullptr && entry->generation == generation) return entry->value;
    std::unique_ptr<Entry> fresh(new Entry{generation, entry, T()});
    if (newest_.compare_exchange_strong(entry, fresh.get())) return fresh.release()->value;
    return entry->value;
  }
  /// Destroys the object of this process, if any. No thread may use it any more.
  void destroy() {
    Entry* const entry = newest_.load();
    if (entry == nullptr || entry->generation != fork_generation()) return;
    newest_ = entry->inherited;
    const std::unique_ptr<Entry> last(entry);
  }

 private:
  struct Entry {
    std::uint64_t generation;
    Entry* inherited;
    T value;
  };
  std::atomic<Entry*> newest_{nullptr};
};

/// An object made at first use that lives until the process ends. With a local static, the child of
/// a fork() could wait for a thread that does not exist there. Two threads may make it at the same
/// time; one is kept.
template <class T>
class MadeOnce {
 public:
  template <class Make>
  const T& get(const Make& make) {
    const T* made = made_.load(std::memory_order_acquire);
    if (made != nullptr) return *made;
    std::unique_ptr<const T> fresh(new const T(make()));
    if (made_.compare_exchange_strong(made, fresh.get())) return *fresh.release();
    return *made;
  }

 private:
  std::atomic<const T*> made_{nullptr};
};

/// A default-constructed T.
template <class T>
const T& empty_value() {
  static constinit MadeOnce<T> made;
  return made.get([] { return T(); });
}

}  // namespace gltfx
