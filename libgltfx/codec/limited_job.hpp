// SPDX-License-Identifier: Apache-2.0
/// Limits of a job, by the size of its payload.
#pragma once

#include <cstddef>
#include <cstdint>

#include "codec/client.hpp"
#include "codec/protocol.hpp"

namespace gltfx::codec {

// Decoders need some hundred bytes for each byte of a well-compressed mesh or image. The least
// limit of any request covers even better compression.
inline constexpr std::uint64_t kMemoryPerByte = 128;
// Ten times the usual need of decoders and encoders, so that slow processors and load from other
// processes do not change results.
inline constexpr double kSecondsPerByte = 5e-6;

inline Job limited_job(const Settings& settings, Task task, std::size_t bytes) {
  Job job;
  job.task = task;
  job.input_bytes = bytes;
  const bool mesh = task == Task::draco || task == Task::encode_draco;
  job.memory_bytes =
      bytes * kMemoryPerByte + (mesh ? settings.mesh_memory_bytes : settings.image_memory_bytes);
  const double seconds = settings.seconds + static_cast<double>(bytes) * kSecondsPerByte;
  job.milliseconds = static_cast<std::uint64_t>(seconds * 1000);
  return job;
}

}  // namespace gltfx::codec
