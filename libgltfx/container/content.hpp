// SPDX-License-Identifier: Apache-2.0
/// Identifies bytes in the place of an asset, a buffer or an image by their beginning.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "container/container.hpp"

namespace gltfx::container {

/// Number of bytes that identify the format.
inline constexpr std::size_t kSniffBytes = 512;

/// Whether a file is a Git LFS pointer, which replaces a file that was not fetched.
bool is_git_lfs_pointer(std::string_view head, std::size_t file_size);

/// The format of a file that begins with `head`. Any text counts as glTF: the JSON parser explains
/// errors best. A `name` that ends in ".glb" decides if the bytes are not recognised.
Format sniff(std::string_view head, std::size_t file_size, std::string_view name);

struct Content {
  std::string_view name;        ///< "a GIF", "an HTML page (a failed download?)"; or empty
  std::string_view media_type;  ///< of an image format that core glTF does not have; or empty
  bool image = false;           ///< some readers accept it as an image
  std::string_view advice;      ///< what to do if it is used as an asset; or empty
};

/// Names formats that glTF does not use, and those that only extensions allow. PNG, JPEG, WebP and
/// KTX 2 are named if they are too short to be read. The name is empty for unknown formats.
/// `bytes` may be the first kSniffBytes of a file of `size` bytes.
Content name_content(std::string_view bytes, std::uint64_t size);
inline Content name_content(std::string_view bytes) { return name_content(bytes, bytes.size()); }

}  // namespace gltfx::container
