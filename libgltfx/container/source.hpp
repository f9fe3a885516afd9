// SPDX-License-Identifier: Apache-2.0
/// Where a container is read from: memory, or a file through pread.
#pragma once

#include <cstdint>
#include <utility>

#include "container/bytes.hpp"
#include "container/file.hpp"

namespace gltfx::container {

/// Does not own the descriptor; shares the memory.
class Source {
 public:
  explicit Source(Bytes bytes) : bytes_(std::move(bytes)), size_(bytes_.size()) {}
  /// `size` is what the file had when it was opened; it may have become shorter since.
  Source(int fd, std::uint64_t size) : fd_(fd), size_(size) {}

  std::uint64_t size() const { return size_; }
  /// A copy of [offset, offset + length), which lies inside [0, size()). `truncated` when the file
  /// has become shorter.
  Copied copy(std::uint64_t offset, std::uint64_t length) const {
    if (fd_ >= 0) return copy_range(fd_, offset, length);
    return {ResolveError::none, share_text(std::string(bytes_.text().substr(offset, length))), {}};
  }

 private:
  Bytes bytes_;
  int fd_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace gltfx::container
