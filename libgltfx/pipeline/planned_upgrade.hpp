// SPDX-License-Identifier: Apache-2.0
/// What an upgrade is to change, to the last byte: from a plan to a change that is placed.
#pragma once

#include <gltfx/upgrade.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "change/apply.hpp"
#include "change/change.hpp"
#include "rules/validated_asset.hpp"

namespace gltfx {

/// Nothing of it is written or checked yet.
struct PlannedUpgrade {
  UpgradeReport report;  ///< where it has a problem, nothing else of this means anything
  /// Placed; the edits of the text may be left out.
  change::Change change;
  change::NewText now;  ///< with all edits made; null where there are none
};

/// `schemas` is never null. Where there are changes, `release` is called when what is left to do
/// hardly ever takes the asset's document, which may be forgotten then.
PlannedUpgrade plan_upgrade(const validate::ValidatedAsset& asset, const UpgradeOptions& options,
                            const std::shared_ptr<const schema::Set>& schemas,
                            const std::function<void()>& release);

/// Why a file is not dealt with as it was asked: the report says that nothing was done.
UpgradeReport failed(UpgradeReport report, EditProblem problem, std::string error);

}  // namespace gltfx
