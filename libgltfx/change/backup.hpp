// SPDX-License-Identifier: Apache-2.0
/// Backups of files that were replaced in place.
#pragma once

#include <optional>
#include <string>

namespace gltfx::change {

/// The path of the backup of the file at `path`.
std::string backup_of(const std::string& path);

/// Restores the backups of the files that an asset refers to below its folder, then that of the
/// asset. Nothing on success, otherwise the reason as a printable half sentence.
std::optional<std::string> restore(const std::string& path);

}  // namespace gltfx::change
