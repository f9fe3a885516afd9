// SPDX-License-Identifier: Apache-2.0
/// Lists the memory of mapped files for signal handlers.
#pragma once

#include <cstddef>
#include <memory>

#include "container/bytes.hpp"

namespace gltfx::container {

struct Mapping;

/// Owns `length` bytes mapped at `start`: unmaps them when the last copy is gone.
std::shared_ptr<const void> own_mapping(void* start, std::size_t length);

/// Whether the mapped file became shorter while it was read and repair_mapping() was called. False
/// for bytes that are not a mapping.
bool is_truncated(const Bytes& bytes);

/// Bounds how much of a mapped file is resident during reading: after every few megabytes read by
/// any thread, all of its pages are released. Repeated reads come from the system's cache. No
/// effect for bytes that are not a mapping.
class ReadMeter {
 public:
  /// `bytes` outlives it.
  explicit ReadMeter(const Bytes& bytes);
  /// Counts bytes that were read.
  void add(std::size_t bytes) const;

 private:
  Mapping* mapping_;  ///< may be null
};

}  // namespace gltfx::container
