// SPDX-License-Identifier: Apache-2.0
/// Finds the fixes that bring a new finding: all fixes are divided into parts, which are tried.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/opened_asset.hpp"
#include "rules/fix_entry.hpp"

namespace gltfx {

/// Positions in a list of sites.
using SitePositions = std::vector<std::size_t>;

/// The number of trials for an asset. A trial costs a validation, and there may be as many as
/// findings: their cost is bounded.
std::uint64_t affordable_trials(const model::OpenedAsset& asset);

/// Halves that share no value; where there are several codes, the sites of each. `shared`: as in
/// PlannedFixes, by site.
std::vector<SitePositions> parts_of(const SitePositions& group, const validate::Sites& sites,
                                    const std::vector<json::NodeId>& shared);

}  // namespace gltfx
