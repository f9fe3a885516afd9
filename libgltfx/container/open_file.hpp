// SPDX-License-Identifier: Apache-2.0
/// A container in a file that is open already.
#pragma once

#include <filesystem>

#include "container/container.hpp"
#include "container/file.hpp"

namespace gltfx::container {

/// As open_file() of container.hpp; `path` is the name of the asset.
Result<Container> open_file(const File& file, const std::filesystem::path& path,
                            const OpenLimits& limits = {});

}  // namespace gltfx::container
