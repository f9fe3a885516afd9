// SPDX-License-Identifier: Apache-2.0
/// What a file has beside its bytes: whether it is still the one that was looked at, and what it
/// would lose when another one takes its place.
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

/// What tells whether a regular file is still the one that was read.
struct FileState {
  std::uint64_t device = 0, inode = 0;
  std::uint64_t size = 0;          ///< bytes
  std::int64_t modified = 0;       ///< nanoseconds since 1970
  std::int64_t status_change = 0;  ///< nanoseconds since 1970; nobody can set it back
  friend bool operator==(const FileState&, const FileState&) = default;
};

/// Which file it is, whatever path leads to it.
struct FileIdentity {
  std::uint64_t device = 0, inode = 0;
  std::string path;  ///< where there is no inode: a file in memory
  // Emscripten's libc++ has no three-way comparison of strings.
  friend bool operator<(const FileIdentity& a, const FileIdentity& b) {
    return std::tie(a.device, a.inode, a.path) < std::tie(b.device, b.inode, b.path);
  }
  friend bool operator==(const FileIdentity&, const FileIdentity&) = default;
};
/// `path` identifies a file that is not on a disk.
FileIdentity identity_of(const FileState& state, std::string_view path);

/// Taken before a file is read. Symbolic links are followed. An Error when there is no regular
/// file.
Result<FileState> file_state(const std::filesystem::path& path);

/// Of a file that is open.
FileState state_of(const struct stat& status);

/// Gives the open file `fd` the owner, permissions and extended attributes (access control lists
/// and security labels among them) of the file at `old`, whose `status` the caller has. An access
/// control list that `fd` inherited from its folder goes when `old` has none. Attributes that hold
/// a hash of the old bytes (IMA, EVM) are not copied: the system makes new ones. Permissions come
/// last, so that the file is never open to more users than the old one. Nothing when all is kept,
/// else the first thing that is not.
std::optional<Error> keep_attributes(int fd, const std::filesystem::path& old,
                                     const struct stat& status);

}  // namespace gltfx

struct stat;
