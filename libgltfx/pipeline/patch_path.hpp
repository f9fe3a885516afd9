// SPDX-License-Identifier: Apache-2.0
/// How a patch names a file.
#pragma once

#include <filesystem>
#include <string>

namespace gltfx {

/// The path of a file from the working folder, without "." and through no symbolic link, where it
/// lies below that folder; otherwise as it is named, without a leading '/'.
std::string patch_path(const std::filesystem::path& path);

}  // namespace gltfx
