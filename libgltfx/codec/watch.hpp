// SPDX-License-Identifier: Apache-2.0
/// Waiting for another process by what it does, not by the clock on the wall: on a busy machine a
/// process may get any share of a processor.
#pragma once

#include <chrono>
#include <optional>

#include <sys/types.h>

namespace gltfx::codec {

/// Processor time that a process and its threads have used. Nothing when there is no such process.
std::optional<std::chrono::nanoseconds> processor_time(pid_t process);

/// What a process may take.
struct Patience {
  std::chrono::milliseconds processor_time;  ///< from the beginning of the wait
  std::chrono::milliseconds standstill;      ///< without using 10 ms of processor time
};

enum class Watch {
  ready,       ///< there is a packet, or the other side has closed
  overrun,     ///< more processor time
  standstill,  ///< the process uses next to no processor time and does not answer
};

/// Waits for a packet of `process` at `socket`.
Watch watch(int socket, pid_t process, const Patience& patience);

}  // namespace gltfx::codec
