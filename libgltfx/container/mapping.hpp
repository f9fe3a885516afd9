// SPDX-License-Identifier: Apache-2.0
/// Which memory is a mapped file, so that a signal handler can tell.
#pragma once

#include <cstddef>
#include <memory>

#include "container/bytes.hpp"

namespace gltfx::container {

struct Mapping;

/// Owns `length` bytes mapped at `start`: unmaps them when the last copy is gone.
std::shared_ptr<const void> own_mapping(void* start, std::size_t length);

/// Whether the file behind the bytes became shorter while it was read, as far as somebody called
/// repair_mapping(). False for bytes that are no mapping.
bool is_torn(const Bytes& bytes);

/// Bounds how much of a mapped file is resident while somebody reads it: after every few megabytes
/// that were read, by whichever thread, all of its pages are let go. What is read again comes from
/// the system's cache. Does nothing for bytes that are no mapping.
class ReadMeter {
 public:
  /// `bytes` outlives it.
  explicit ReadMeter(const Bytes& bytes);
  /// So many bytes were read.
  void add(std::size_t bytes) const;

 private:
  Mapping* mapping_;  ///< may be null
};

}  // namespace gltfx::container
