// SPDX-License-Identifier: Apache-2.0
/// What fixes of rules come to in one asset, and whether that makes it worse.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "model/opened_asset.hpp"
#include "schema/set.hpp"
#include "validate/fix.hpp"
#include "validate/validated_asset.hpp"

namespace gltfx {

/// How the verb judges: all that headers of images tell, hints too.
ValidateOptions fix_judgement(const std::shared_ptr<const schema::Set>& schemas);

/// The asset anew, so that it can be judged.
model::OpenedAsset opened_anew(const model::OpenedAsset& asset);

/// Changes of one asset by fixes, and which sites they are about, by position.
struct PlannedFixes {
  validate::Fixing::Changes changes;
  std::vector<bool> fixed;
};

/// `sites` are those of the asset as it is; those that are `wanted`, by position, are to be fixed.
/// Only fixes of the first stage that has some are made. Nothing where a buffer that changes cannot
/// be found.
std::optional<PlannedFixes> plan_fixes(const model::OpenedAsset& asset,
                                       const validate::Sites& sites, const schema::Set& schemas,
                                       const std::vector<bool>& wanted);

/// The asset with the changes.
Result<model::OpenedAsset> with_changes(const model::OpenedAsset& asset,
                                        const validate::Fixing::Changes& changes);

/// Codes of which `after` has more findings than `before`.
std::vector<std::string_view> worse_codes(const FileReport& before, const FileReport& after);

}  // namespace gltfx
