// SPDX-License-Identifier: Apache-2.0
/// Facts about an asset for a report.
#pragma once

#include <gltfx/report.hpp>

#include "model/asset.hpp"
#include "model/views.hpp"

namespace gltfx::model {

/// What the Khronos report's `info` block says, counted as that validator does; `resources` is left
/// empty, for it needs the files. Malformed members count as absent. Linear in the document.
AssetInfo asset_info(const Asset& asset, const Views& views);

}  // namespace gltfx::model
