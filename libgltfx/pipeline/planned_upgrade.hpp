// SPDX-License-Identifier: Apache-2.0
/// What an upgrade is to change, settled to the last byte: from a plan to edits of the text, bytes
/// of the BIN chunk and new files.
#pragma once

#include <gltfx/upgrade.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/shared_text.hpp"
#include "edit/new_file.hpp"
#include "edit/rewrite.hpp"
#include "json/parse.hpp"
#include "validate/validated_asset.hpp"

namespace gltfx {

/// Nothing of it is written or checked yet.
struct PlannedUpgrade {
  UpgradeReport report;  ///< where it has a problem, nothing else of this means anything
  edit::BinChange bin;
  std::vector<edit::NewFile> files;  ///< that the new document refers to
  SharedText text;                   ///< with all edits made; null where there is none
  json::Parsed parsed;               ///< of that; without nodes where nobody needed it yet
};

/// `schemas` is never null. Where there are changes, `release` is called when what is left to do
/// hardly ever takes the asset's document, which may be forgotten then.
PlannedUpgrade plan_upgrade(const validate::ValidatedAsset& asset, const UpgradeOptions& options,
                            const std::shared_ptr<const schema::Set>& schemas,
                            const std::function<void()>& release);

/// Why a file is not dealt with as it was asked: the report says that nothing was done.
UpgradeReport failed(UpgradeReport report, EditProblem problem, std::string error);

/// The asset that the changed container makes, with new files where it looks for them. The new text
/// is not parsed a second time.
model::OpenedAsset upgraded(const model::OpenedAsset& before, PlannedUpgrade& plan,
                            container::Container changed);

}  // namespace gltfx
