// SPDX-License-Identifier: Apache-2.0
/// Pictures for callers that know more than the name of a file.
#pragma once

#include <gltfx/bake.hpp>

#include <string>

#include "pipeline/cached_picture.hpp"
#include "rules/validated_asset.hpp"

namespace gltfx {

/// As bake_file(), of what was validated already or never stood in a file.
BakeReport bake_asset(validate::ValidatedAsset asset, const BakeOptions& options);

/// As bake_file(), with keys that many files have in common.
BakeReport bake_with_key(const std::string& path, const BakeOptions& options, PictureKey& keys);

}  // namespace gltfx
