// SPDX-License-Identifier: Apache-2.0
/// Regular files as descriptors: opened without blocking, copied with pread or mapped; also
/// confined to a folder, despite "..", links and races.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "base/file_state.hpp"
#include "base/unique_fd.hpp"
#include "container/bytes.hpp"
#include "container/resolve_error.hpp"

namespace gltfx::container {

/// An open regular file, or an error.
struct File {
  UniqueFd fd;
  std::uint64_t size = 0;  ///< bytes when it was opened
  FileState state;         ///< when it was opened
  ResolveError error = ResolveError::none;
  std::string problem;
};

/// A File with an error; the text is that of the system.
File file_error(int error);

/// Opens `path` for reading, relative to `folder` (AT_FDCWD: the current one). `flags` are added to
/// the default flags. It does not block on a FIFO or a device.
File open_regular(int folder, const char* path, int flags = 0);

/// Takes over a descriptor that the caller opened; an error unless it is a regular file.
File adopt_regular(UniqueFd fd);

/// Bytes that were read, or an error.
struct Loaded {
  ResolveError error = ResolveError::none;
  Bytes bytes;
  std::string problem;
};

/// Text that was read, or an error.
struct Copied {
  ResolveError error = ResolveError::none;
  SharedText text;  ///< not null when there is no error
  std::string problem;
};

/// Copies [offset, offset + length) with pread; `truncated` when the file ends before.
/// Precondition: the length was checked against the file's size.
Copied copy_range(int fd, std::uint64_t offset, std::uint64_t length);

/// Maps the whole file read-only and private. No byte is read yet.
Loaded map_file(int fd, std::uint64_t size);

/// Files up to this size are copied: that costs less than a mapping and cannot fault later.
inline constexpr std::uint64_t kCopyBelow = 16384;

/// The whole file: a copy when it is small, else a mapping.
Loaded load_file(const File& file);

/// How the root is enforced. `automatic` uses the kernel (openat2 with RESOLVE_BENEATH), and user
/// space if the kernel refuses; `by_hand` is for tests and old kernels. Both give the same results.
enum class Confinement : std::uint8_t { automatic, by_hand };

/// Opens `path` below the folder `root` (any descriptor of it, also O_PATH).
///
/// Symbolic links are followed, at most 40; an absolute one only when it leads back into the root.
/// ".." above the root is `outside_root`, and so is any target of a link outside, existing or not,
/// so that files outside cannot be probed. Only regular files are opened, without blocking.
File open_beneath(int root, const std::string& path, Confinement confinement);

/// The implementation in user space: opens component after component, each with a descriptor of its
/// parent folder.
File walk_beneath(int root, const std::string& path);

/// Bytes in memory or of a file. Does not own the descriptor; shares the memory.
class Source {
 public:
  explicit Source(Bytes bytes) : bytes_(std::move(bytes)), size_(bytes_.size()) {}
  /// `size` is the size of the file when it was opened; it may be shorter now.
  Source(int fd, std::uint64_t size) : fd_(fd), size_(size) {}

  std::uint64_t size() const { return size_; }
  /// A copy of [offset, offset + length), which is inside [0, size()). `truncated` when the file
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
