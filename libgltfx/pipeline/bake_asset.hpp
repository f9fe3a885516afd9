// SPDX-License-Identifier: Apache-2.0
/// Pictures for callers that know more than the name of a file.
#pragma once

#include <gltfx/bake.hpp>

#include <string>

#include "pipeline/kept_picture.hpp"
#include "pipeline/opened_asset.hpp"

namespace gltfx {

/// As bake_file(), of what was opened already or never stood in a file; `path` is its name.
BakeReport bake_asset(const std::string& path, OpenedAsset asset, const BakeOptions& options);

/// As bake_file(), with keys that many files have in common.
BakeReport bake_with_key(const std::string& path, const BakeOptions& options, PictureKey& keys);

}  // namespace gltfx
