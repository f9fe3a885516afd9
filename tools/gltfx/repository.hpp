// SPDX-License-Identifier: Apache-2.0
/// The working tree of git that a folder is in.
#pragma once

#include <filesystem>

namespace gltfx::tool {

/// The nearest folder with an entry `.git`, from `folder` upwards; empty: none. `folder` is
/// absolute.
std::filesystem::path repository_of(const std::filesystem::path& folder);

}  // namespace gltfx::tool
