// SPDX-License-Identifier: Apache-2.0
/// Reasons why a file could not be read, and their texts for people.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gltfx::container {

/// Why a resource could not be opened.
enum class ResolveError : std::uint8_t {
  none,
  not_found,
  outside_root,  ///< "..", an absolute path or a symbolic link leads out of the root
  not_regular,   ///< a folder, FIFO, socket or device
  no_permission,
  no_root,  ///< standard input without --root: external files are not looked up
  io_error,
  truncated,  ///< shorter than when it was opened
  too_large,
};

/// The error for the errno of a system call.
ResolveError error_of_errno(int error);

/// The system's text for an errno. Thread-safe.
std::string errno_text(int error);

/// One sentence that names `path` (shown printable) and the error. `problem` is a detail such as
/// `Resolved::problem`, appended after a colon if it adds something.
std::string describe(ResolveError error, std::string_view path, std::string_view problem = {});

/// What to do about it, one sentence; empty for `none`.
std::string_view help(ResolveError error);

}  // namespace gltfx::container
