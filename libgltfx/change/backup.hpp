// SPDX-License-Identifier: Apache-2.0
/// The old bytes of what was replaced in place, kept beside it on request.
#pragma once

#include <optional>
#include <string>

namespace gltfx::change {

/// Where the old bytes of the file at `path` are kept.
std::string backup_of(const std::string& path);

/// Moves the old bytes of an asset to their place, after those of the files that it refers to and
/// that lie below its folder. Nothing when all is done, else why not; a printable half sentence.
std::optional<std::string> restore(const std::string& path);

}  // namespace gltfx::change
