// SPDX-License-Identifier: Apache-2.0
/// What verbs that change one asset say of its external assets (glTF 2.1), which stay as they are.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/opened_asset.hpp"

namespace gltfx {

/// The names of the assets below this one, at any depth, for which `wanted` is true; sorted, each
/// once.
std::vector<std::string> external_assets_where(
    const model::OpenedAsset& asset, const std::function<bool(const model::OpenedAsset&)>& wanted);

}  // namespace gltfx
