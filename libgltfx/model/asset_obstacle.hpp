// SPDX-License-Identifier: Apache-2.0
/// Why nothing can be made of an asset.
#pragma once

#include <optional>

#include "base/result.hpp"
#include "model/opened_asset.hpp"

namespace gltfx::model {

/// Why nothing but a report can be made of the asset, as half a sentence: its container has no text
/// of a document, or nothing can be made of that text. Nothing when something can.
std::optional<Error> find_obstacle(const OpenedAsset& asset);

/// Why the asset cannot be part of another one, likewise: that, or it is not of glTF 2.
std::optional<Error> find_obstacle_of_child(const OpenedAsset& asset);

}  // namespace gltfx::model
