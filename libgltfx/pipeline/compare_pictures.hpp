// SPDX-License-Identifier: Apache-2.0
/// Pictures of the two assets of a comparison.
#pragma once

#include <gltfx/compare.hpp>

#include <optional>
#include <vector>

#include "model/opened_asset.hpp"
#include "prove/change_places.hpp"

namespace gltfx {

/// Draws both from one camera that sees both, from two sides, and the object of the greatest
/// change; sets pictures and picture_problem of the report. Nothing: there is no such asset, and
/// the other one is drawn alone. `boxes`: of the first changes of the report.
void draw_compared(std::optional<model::OpenedAsset> before,
                   std::optional<model::OpenedAsset> after,
                   const std::vector<prove::ChangedBoxes>& boxes, const CompareOptions& options,
                   CompareReport& report);

}  // namespace gltfx
