// SPDX-License-Identifier: Apache-2.0
/// A decoding process, the socket to it, and a wait that measures its processor time, not
/// wall-clock time: on a busy machine a process may get any share of a processor.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include <sys/types.h>

#include "base/fork.hpp"

namespace gltfx::codec {

/// Processor time that a process and its threads have used. Nothing if the process does not exist.
std::optional<std::chrono::nanoseconds> processor_time(pid_t process);

/// Time limits of a process.
struct Patience {
  std::chrono::milliseconds processor_time;  ///< from the start of the wait
  std::chrono::milliseconds standstill;      ///< without using 10 ms of processor time
};

enum class Watch {
  ready,       ///< there is a packet, or the other side has closed
  overrun,     ///< it used more processor time
  standstill,  ///< it uses almost no processor time and does not answer
};

/// Waits for a packet of `process` at `socket`.
Watch watch(int socket, pid_t process, const Patience& patience);

/// Descriptor of a worker's socket.
inline constexpr int kSocketDescriptor = 3;
/// Descriptor of a worker's lifeline: a pipe without data that closes when the client's process
/// ends.
inline constexpr int kLifelineDescriptor = 4;

/// The ends of a worker or launcher: its socket and lifeline, and the client's.
struct Ends {
  OwnDescriptor socket, lifeline;                // for the client
  OwnDescriptor worker_socket, worker_lifeline;  // for the worker
  static Ends create();
  bool complete() const { return socket && lifeline && worker_socket && worker_lifeline; }
};

/// A running program; the destructor ends it.
class Process {
 public:
  /// Starts a program without arguments and with an empty environment, with only its two ends and
  /// /dev/null open, and default signal handling. `started()` reports success.
  explicit Process(const std::string& program);
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() { end(); }

  bool started() const { return id_ > 0; }
  /// Why it was not started. Precondition: !started().
  std::string start_error() const;
  /// Whether it was not started because the system had no process, memory or descriptor left, which
  /// may be temporary.
  bool lacked_resources() const;
  pid_t id() const { return id_; }
  int socket() const { return socket_.get(); }
  /// Ends the process if it runs, and returns how it ended: half a sentence.
  std::string end();

 private:
  pid_t id_ = -1;
  int start_error_ = 0;
  OwnDescriptor socket_, lifeline_;
};

}  // namespace gltfx::codec
