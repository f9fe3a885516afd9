// SPDX-License-Identifier: Apache-2.0
/// Workers of one kind, shared by threads: one request per worker at a time. One process loads the
/// decoders, and each worker is a fork of it, which takes a hundredth of the time.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/fork.hpp"
#include "base/origin.hpp"
#include "codec/client.hpp"
#include "codec/packet.hpp"
#include "codec/process.hpp"
#include "codec/protocol.hpp"
#include "codec/shared_memory.hpp"

namespace gltfx::codec {

class Worker;

/// Thread-safe. Workers must not outlive it.
class Launcher {
 public:
  /// A program is not started again if it uses no processor time for `standstill` before it greets,
  /// or if it fails to start three times in a row.
  Launcher(std::string program, std::chrono::milliseconds standstill)
      : program_(std::move(program)), standstill_(standstill) {}

  /// Starts the program, without waiting for it, unless it runs.
  void prepare();
  /// Errors are of kind `unavailable`.
  std::variant<std::unique_ptr<Worker>, DecodeError> start(std::uint64_t memory_bytes);
  /// Ends a worker, see Worker::end().
  int finish(pid_t worker);

 private:
  // The reason of a failure, half a sentence, or nothing.
  using Trouble = std::optional<std::string>;
  Trouble launch();
  Trouble greet();
  Trouble greet(Worker& worker);
  std::optional<Control> ask(const Control& control, std::span<const int> descriptors);
  DecodeError not_started(const std::string& why) const;

  const std::string program_;
  const std::chrono::milliseconds standstill_;
  std::mutex mutex_;
  std::unique_ptr<Process> process_;      ///< null: not started, or failed
  bool ready_ = false;                    ///< the process has greeted
  int failures_ = 0;                      ///< failed starts in a row
  Trouble final_;                         ///< why it is not started again
  std::atomic<bool> unfiltered_ = false;  ///< its workers have no filter of system calls
};

/// A worker process; the destructor ends it.
class Worker {
 public:
  Worker(Launcher& launcher, pid_t id, Ends ends, std::uint64_t memory_bytes)
      : launcher_(launcher),
        id_(id),
        socket_(std::move(ends.socket)),
        lifeline_(std::move(ends.lifeline)),
        memory_bytes_(memory_bytes) {}
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker();

  pid_t id() const { return id_; }
  int socket() const { return socket_.get(); }
  /// The maximum memory of a job.
  std::uint64_t memory_bytes() const { return memory_bytes_; }
  /// Ends the process. Returns the signal that ended it, or 0.
  int end() { return id_ > 0 ? launcher_.finish(std::exchange(id_, -1)) : 0; }

  Origin origin;  ///< of all bytes that it has been given

 private:
  Launcher& launcher_;
  pid_t id_;
  OwnDescriptor socket_, lifeline_;
  std::uint64_t memory_bytes_;
};

/// An answer with its spans attached, and the memory that they point into.
struct Reply {
  Answer answer;
  Taken memory;
};

/// Thread-safe. Starts workers on demand, up to `most` (0: the number of processors). A worker gets
/// bytes of one origin only. May throw std::bad_alloc.
class Pool {
 public:
  /// A worker that neither works nor answers for the time `standstill` is stopped.
  Pool(std::string program, unsigned most, std::chrono::milliseconds standstill);
  Reply ask(const Job& job, std::span<const std::byte> bytes, const Origin& origin);
  /// Prepares to start workers, without waiting.
  void prepare() { launcher_.prepare(); }

 private:
  using Kept = std::unique_ptr<Worker>;
  struct Lease;
  Reply ask(Kept& worker, const Job& job, std::span<const std::byte> bytes, const Origin& origin);
  Reply answer_of(Kept worker, const Job& job, int result, Kept& sound) const;

  const std::chrono::milliseconds standstill_;
  const unsigned most_;
  Launcher launcher_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Kept> idle_;  ///< the most recently used last
  unsigned leased_ = 0;
};

}  // namespace gltfx::codec
