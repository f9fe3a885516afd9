// SPDX-License-Identifier: Apache-2.0
/// The sandbox of a worker. The steps are independent; the client is informed whether the most
/// important one, the filter of system calls, is active, and decides.
#pragma once

#include <cstdint>

namespace gltfx::codec {

/// Closes all descriptors from `first` on.
void close_descriptors_from(int first);

/// Ends the process by a signal as soon as the other end of a pipe is closed, even during decoding.
void end_with(int lifeline);

/// Forbids permanently, also for root: capabilities, new privileges, new processes, core dumps,
/// files above `most_file_bytes`, and all system calls except those for memory, the socket and the
/// end of the process; a forbidden call fails with EPERM. True if the filter is active: never on
/// processors other than x86-64 and 64-bit ARM.
bool lock_in(std::uint64_t most_file_bytes);

/// Limits on memory and time, relative to the use of the process at construction.
class JobLimits {
 public:
  /// No job may take more than `most_memory_bytes`: a hard limit, which the process cannot raise.
  explicit JobLimits(std::uint64_t most_memory_bytes);
  /// The process ends with SIGPROF at the limit of processor time; allocations fail above the
  /// memory limit, except in builds with AddressSanitizer, which reserves terabytes.
  void begin(std::uint64_t memory_bytes, std::uint64_t milliseconds) const;
  static void end();

 private:
  std::uint64_t baseline_ = 0;  ///< bytes of address space
};

}  // namespace gltfx::codec
