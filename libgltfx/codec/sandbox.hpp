// SPDX-License-Identifier: Apache-2.0
/// How a worker locks itself in. Each step works without the others; whether the most important
/// one, the filter of system calls, is in force is reported to the client, which decides.
#pragma once

#include <cstdint>

namespace gltfx::codec {

/// Closes every descriptor from `first` on.
void close_descriptors_from(int first);

/// Lets the process end by a signal as soon as nobody holds the other end of a pipe, even amid
/// decoding.
void end_with(int lifeline);

/// Forbids for good, to root as well: capabilities, new privileges, new processes, core dumps,
/// files beyond `most_file_bytes`, and every system call but those that memory, the socket and the
/// end of the process need; one that is forbidden fails with EPERM. True when the filter is in
/// force: never on processors other than x86-64 and 64-bit ARM.
bool lock_in(std::uint64_t most_file_bytes);

/// Limits on memory and time, counted from what the process has taken when this was made.
class JobLimits {
 public:
  /// No job may take more than `most_memory_bytes`: a hard limit, which the process cannot raise.
  explicit JobLimits(std::uint64_t most_memory_bytes);
  /// The process ends with SIGPROF after so much processor time; allocations fail beyond so much
  /// memory, but in builds with AddressSanitizer, which reserves terabytes.
  void begin(std::uint64_t memory_bytes, std::uint64_t milliseconds) const;
  static void end();

 private:
  std::uint64_t baseline_ = 0;  ///< bytes of address space
};

}  // namespace gltfx::codec
