// SPDX-License-Identifier: Apache-2.0
/// Tells a file's format by its first bytes.
#pragma once

#include <cstddef>
#include <string_view>

#include "container/container.hpp"

namespace gltfx::container {

/// Bytes that are enough to tell the format.
inline constexpr std::size_t kSniffBytes = 512;

/// The first line of a Git-LFS pointer file, which stands where the real file was not fetched.
bool is_git_lfs_pointer(std::string_view head, std::size_t file_size);

/// The format of a file that begins with `head`. Text of any kind counts as glTF: the JSON parser
/// says best what is wrong with it. A `name` that ends in ".glb" decides where the bytes are none
/// of the known kinds.
Format sniff(std::string_view head, std::size_t file_size, std::string_view name);

}  // namespace gltfx::container
