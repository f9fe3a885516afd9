// SPDX-License-Identifier: Apache-2.0
/// A process that forks while its threads are at work. Only the thread that calls fork() goes on in
/// the child: what other threads had locked stays locked there, what they were making is never
/// made, and pools have no threads.
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

/// Told of each fork() by the thread that calls it, the newest watcher first.
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

/// A mutex that no other thread holds when the process forks. To be held for short times, and with
/// no other one locked beneath it.
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

/// For std::shared_lock. Any number of threads may be inside, but none when the process forks:
/// around calls of libraries that do not expect a fork.
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

/// A descriptor that is closed in the child of a fork(): a copy there would keep the other side
/// waiting.
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

/// The process does not fork while it lives: from opening descriptors until they have an owner.
class NoFork {
 public:
  NoFork();
  ~NoFork();
  NoFork(const NoFork&) = delete;
  NoFork& operator=(const NoFork&) = delete;

  /// Takes over a descriptor; -1 is none.
  OwnDescriptor own(int fd) const;
};

/// What each process has one of, made when it is first asked for: the child of a fork() makes its
/// own and leaves that of its parent alone. Any number of threads may ask.
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
  /// Ends the one of this process, if there is any, when no thread uses it any more.
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

/// What is made when it is first asked for, and stays until the process ends. Of a local static the
/// child of a fork() would wait for a thread that is not there. Two threads that ask at the same
/// time may both make it; one is kept.
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

/// A T that nothing was put into.
template <class T>
const T& empty_value() {
  static constinit MadeOnce<T> made;
  return made.get([] { return T(); });
}

}  // namespace gltfx
