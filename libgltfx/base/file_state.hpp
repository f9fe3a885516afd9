// SPDX-License-Identifier: Apache-2.0
/// The state of a file apart from its bytes: whether it is unchanged, and the attributes that a
/// replacement must keep.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "base/result.hpp"

struct stat;

namespace gltfx {

/// Shows whether a regular file changed since it was read.
struct FileState {
  std::uint64_t device = 0, inode = 0;
  std::uint64_t size = 0;          ///< bytes
  std::int64_t modified = 0;       ///< nanoseconds since 1970
  std::int64_t status_change = 0;  ///< nanoseconds since 1970; cannot be set back
  friend bool operator==(const FileState&, const FileState&) = default;
};

/// Identity of a file, independent of the path.
struct FileIdentity {
  std::uint64_t device = 0, inode = 0;
  std::string path;  ///< for a file in memory, which has no inode
  // Emscripten's libc++ has no three-way comparison of strings.
  friend bool operator<(const FileIdentity& a, const FileIdentity& b) {
    return std::tie(a.device, a.inode, a.path) < std::tie(b.device, b.inode, b.path);
  }
  friend bool operator==(const FileIdentity&, const FileIdentity&) = default;
};
/// `path` identifies a file that is not on disk.
FileIdentity identity_of(const FileState& state, std::string_view path);

/// Taken before a file is read. Symbolic links are followed. An Error when there is no regular
/// file.
Result<FileState> file_state(const std::filesystem::path& path);

/// The state of an open file.
FileState state_of(const struct stat& status);

/// Gives the open file `fd` the owner, permissions and extended attributes (access control lists
/// and security labels among them) of the file at `old`, whose `status` the caller has. An access
/// control list that `fd` inherited from its folder is removed when `old` has none. Attributes that
/// hold a hash of the old bytes (IMA, EVM) are not copied: the system makes new ones. Permissions
/// come last, so that the file is never open to more users than the old one. Nothing when all is
/// kept, else the first error.
std::optional<Error> keep_attributes(int fd, const std::filesystem::path& old,
                                     const struct stat& status);

}  // namespace gltfx

struct stat;
