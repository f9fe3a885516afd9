// SPDX-License-Identifier: Apache-2.0
/// A picture of what was opened already, or never stood in a file.
#pragma once

#include <gltfx/bake.hpp>

#include <string>

#include "pipeline/opened_asset.hpp"

namespace gltfx {

/// As bake_file(); `path` is the name of the asset.
BakeReport bake_asset(const std::string& path, OpenedAsset asset, const BakeOptions& options);

}  // namespace gltfx
