// SPDX-License-Identifier: Apache-2.0
/// Files are changed whole or not at all: what stands at a path is the old bytes or the new ones,
/// also when the power fails, and a change by somebody else is never overwritten.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "base/file_state.hpp"
#include "base/result.hpp"

namespace gltfx {

/// Puts `bytes` in the place of the file that was `seen`: a temporary file in the same folder gets
/// them, then owner, permissions and extended attributes of the old one, is made durable and
/// renamed; the folder is made durable too. A symbolic link stays; what it leads to is replaced.
/// Refused when the file is not as it was seen, has other hard links, is read-only, or has an
/// attribute that cannot be kept. Nothing when the new bytes are durable, else why they are not.
std::optional<Error> replace_file(const std::filesystem::path& path, std::string_view bytes,
                                  const FileState& seen);

/// Why replace_file() would refuse now; nothing when it would try.
std::optional<Error> check_replaceable(const std::filesystem::path& path, const FileState& seen);

/// The same for a file that must not exist yet.
std::optional<Error> create_file(const std::filesystem::path& path, std::string_view bytes);

/// What replaces a file or creates one: the state of the file at `path`, nothing where there is
/// none.
Result<std::optional<FileState>> state_if_there(const std::filesystem::path& path);

/// Creates the file, or replaces it as it is now.
std::optional<Error> write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace gltfx
