// SPDX-License-Identifier: Apache-2.0
/// What bytes are that stand where an asset, a buffer or an image should, told by their beginning.
#pragma once

#include <cstddef>
#include <cstdint>
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

struct Content {
  std::string_view name;        ///< "a GIF", "an HTML page (a failed download?)"; or empty
  std::string_view media_type;  ///< of an image that no part of glTF itself knows; or empty
  bool image = false;           ///< some reader may take it for an image
  std::string_view advice;      ///< what to do where it is in the place of an asset; or empty
};

/// Names formats that glTF has no use for, and those that only extensions bring. PNG, JPEG, WebP
/// and KTX 2 are named where they are too short to be read. No name: nothing that is known here.
/// `bytes` may be the first kSniffBytes of a file of `size` bytes.
Content name_content(std::string_view bytes, std::uint64_t size);
inline Content name_content(std::string_view bytes) { return name_content(bytes, bytes.size()); }

}  // namespace gltfx::container
