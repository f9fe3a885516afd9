// SPDX-License-Identifier: Apache-2.0
/// A worker process and the socket to it.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include <sys/types.h>

#include "base/unique_fd.hpp"

namespace gltfx::codec {

/// Where a worker finds its ends.
inline constexpr int kSocketDescriptor = 3;
/// Readable, without ever a byte in it: it ends when the client's process ends.
inline constexpr int kLifelineDescriptor = 4;

/// A running worker; its end ends the process.
class Process {
 public:
  /// Starts a program without arguments, with nothing open but its two ends and /dev/null, all
  /// signals as they are by default. `started()` tells whether that went well.
  explicit Process(const std::string& program);
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() { end(); }

  bool started() const { return id_ > 0; }
  int socket() const { return socket_.get(); }
  /// Whether the program has said what it is.
  bool greeted() const { return greeted_; }
  void set_greeted() { greeted_ = true; }

  /// Whether the process runs no more.
  bool has_ended() const;
  /// The signal that has ended the process; 0 when it ended otherwise, or not within a moment.
  int cause_of_death();
  /// Ends the process if it has not ended.
  void end();

 private:
  pid_t id_ = -1;
  bool greeted_ = false;
  UniqueFd socket_, lifeline_;
};

}  // namespace gltfx::codec
