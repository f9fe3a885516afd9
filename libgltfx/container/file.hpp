// SPDX-License-Identifier: Apache-2.0
/// Regular files as descriptors: opened without blocking, copied with pread or mapped.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/file_state.hpp"
#include "base/unique_fd.hpp"
#include "container/bytes.hpp"
#include "container/resolve_error.hpp"

namespace gltfx::container {

/// An open regular file, or why there is none.
struct File {
  UniqueFd fd;
  std::uint64_t size = 0;  ///< bytes when it was opened
  FileState state;         ///< when it was opened
  ResolveError error = ResolveError::none;
  std::string problem;
};

/// A File that says why there is none; the words are those of the system.
File file_error(int error);

/// Opens `path` for reading, relative to `folder` (AT_FDCWD: the current one). `flags` are added
/// to those every file is opened with. Neither a FIFO nor a device can make it wait.
File open_regular(int folder, const char* path, int flags = 0);

/// Takes over a descriptor opened by somebody else; an error unless it is a regular file.
File adopt_regular(UniqueFd fd);

/// Bytes that were read, or why not.
struct Loaded {
  ResolveError error = ResolveError::none;
  Bytes bytes;
  std::string problem;
};

/// Text that was read, or why not.
struct Copied {
  ResolveError error = ResolveError::none;
  SharedText text;  ///< not null when there is no error
  std::string problem;
};

/// Copies [offset, offset + length) with pread; `truncated` when the file ends before. The caller
/// has checked the length against the file's size.
Copied copy_range(int fd, std::uint64_t offset, std::uint64_t length);

/// Maps the whole file read-only and private. No byte is read now.
Loaded map_file(int fd, std::uint64_t size);

/// Files up to this size are copied: that costs less than a mapping and cannot fault later.
inline constexpr std::uint64_t kCopyBelow = 16384;

/// The whole file: a copy when it is small, else a mapping.
Loaded load_file(const File& file);

}  // namespace gltfx::container
