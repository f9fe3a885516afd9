// SPDX-License-Identifier: Apache-2.0
/// What processes that were killed have left behind.
#pragma once

#include <filesystem>
#include <string>

namespace gltfx {

/// The name of a temporary file beside `target`: that, and what tells whose it is. `number` tells
/// those of one process apart.
std::string temporary_name(const std::filesystem::path& target, int number);

/// Deletes temporary files that processes which no longer run have left beside `target`. Numbers of
/// processes say nothing of other machines, which may share the folder: what they have left is
/// deleted when nobody wrote to it for a day. A folder is read once in the life of a process. Any
/// number of threads may call.
void remove_stale_files(const std::filesystem::path& target);

}  // namespace gltfx
