// SPDX-License-Identifier: Apache-2.0
/// The container that a conversion makes.
#pragma once

#include <gltfx/convert.hpp>

#include <optional>

#include "model/opened_asset.hpp"

namespace gltfx {

/// How the output is to be stored where that is not how the input is: requested, or implied by its
/// name.
std::optional<StoredAs> form_of(const model::OpenedAsset& asset, const ConvertOptions& options);

/// The version of the new GLB; nothing: there is none, or it keeps its version. Precondition:
/// `options.to` is from form_of().
std::optional<GlbVersion> glb_version_of(const model::OpenedAsset& asset,
                                         const ConvertOptions& options);

}  // namespace gltfx
