// SPDX-License-Identifier: Apache-2.0
/// What processes that were killed have left behind.
#pragma once

#include <filesystem>

namespace gltfx {

/// Deletes temporary files that replace_file() or create_file() of processes which no longer run
/// have left beside `target`. A folder is read once in the life of a process. Any number of threads
/// may call.
void remove_stale_files(const std::filesystem::path& target);

}  // namespace gltfx
