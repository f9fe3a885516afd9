// SPDX-License-Identifier: Apache-2.0
/// What the readers of both versions of GLB share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "container/glb.hpp"

namespace gltfx::container {

/// A number of `size` bytes, little endian. Precondition: they are inside of `bytes`.
inline std::uint64_t number_at(std::string_view bytes, std::size_t at, unsigned size) {
  std::uint64_t value = 0;
  for (unsigned i = 0; i < size; ++i) {
    value |= std::uint64_t{static_cast<unsigned char>(bytes[at + i])} << (8U * i);
  }
  return value;
}

/// Copies bytes of a source and collects errors. A step returns false when there is nothing left to
/// read.
class ChunkReader {
 protected:
  ChunkReader(const Source& source, Container& out) : source_(source), out_(out) {}

  void early(ContainerError error) { out_.errors.push_back(std::move(error)); }
  void late(ContainerError error) { out_.late_errors.push_back(std::move(error)); }

  bool stop_short(ContainerError error) {
    out_.cut_short = true;
    late(std::move(error));
    return false;
  }

  /// False: the source cannot be read, which is in `failure_` then.
  bool copy(std::uint64_t offset, std::uint64_t length, SharedText& text) {
    Copied copied = source_.copy(offset, length);
    if (copied.error != ResolveError::none) {
      failure_ = std::move(copied);
      return false;
    }
    text = std::move(copied.text);
    return true;
  }

  const Source& source_;
  Container& out_;
  std::optional<Copied> failure_;
};

}  // namespace gltfx::container
