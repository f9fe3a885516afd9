// SPDX-License-Identifier: Apache-2.0
/// Whether a file is still the one that was looked at.
#pragma once

#include <cstdint>
#include <filesystem>

#include "base/result.hpp"

struct stat;

namespace gltfx {

/// What tells whether a regular file is still the one that was read.
struct FileState {
  std::uint64_t device = 0, inode = 0;
  std::uint64_t size = 0;          ///< bytes
  std::int64_t modified = 0;       ///< nanoseconds since 1970
  std::int64_t status_change = 0;  ///< nanoseconds since 1970; nobody can set it back
  friend bool operator==(const FileState&, const FileState&) = default;
};

/// Taken before a file is read. Symbolic links are followed. An Error when there is no regular
/// file.
Result<FileState> file_state(const std::filesystem::path& path);

/// Of a file that is open.
FileState state_of(const struct stat& status);

}  // namespace gltfx
