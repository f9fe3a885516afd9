// SPDX-License-Identifier: Apache-2.0
/// Fixes over and over, until none is left to do: what one of them makes may be what another fixes.
#pragma once

#include <gltfx/fix.hpp>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edit/new_file.hpp"
#include "json/edit.hpp"
#include "validate/fix.hpp"
#include "validate/validated_asset.hpp"

namespace gltfx {

/// How the verb judges: all that headers of images tell, hints too.
ValidateOptions fix_judgement(const std::shared_ptr<const schema::Set>& schemas);

/// Changes of one asset by the fixes of some rules, and what they are about.
struct PlannedFixes {
  validate::Fixing::Changes changes;
  std::vector<FixAction> done, left;  ///< by code; what is left says why
  std::vector<bool> fixed;            ///< by site
};

/// `sites` are those of the asset as it is. `wants` says of a code whether its findings are to be
/// fixed. Only fixes of the first stage that has some are made. Nothing where a buffer that changes
/// cannot be found.
std::optional<PlannedFixes> plan_fixes(const model::OpenedAsset& asset,
                                       const validate::Sites& sites, const schema::Set& schemas,
                                       const std::function<bool(Code)>& wants);

/// Which sites safe fixes fix, by their position; none where the asset cannot be written.
std::vector<bool> fixable_sites(const model::OpenedAsset& asset, const validate::Sites& sites,
                                const schema::Set& schemas);

/// The asset with the changes.
Result<model::OpenedAsset> with_changes(const model::OpenedAsset& asset,
                                        const validate::Fixing::Changes& changes);

/// What all rounds came to.
struct FixedAsset {
  /// The asset after the last of them.
  validate::ValidatedAsset after;
  std::vector<FixAction> actions;  ///< as in FixReport
  std::vector<json::Edit> edits;   ///< of the old text; only where they were asked for
  std::map<std::string, edit::ReplacedFile> files;  ///< by path
  bool changes = false;
};

/// `before` was judged by fix_judgement(). `keeps_edits`: FixedAsset::edits are wanted.
FixedAsset fix_in_rounds(validate::ValidatedAsset before, const FixOptions& options,
                         const std::shared_ptr<const schema::Set>& schemas, bool keeps_edits);

/// Codes of which `after` has more findings than `before`.
std::vector<std::string_view> worse_codes(const FileReport& before, const FileReport& after);

}  // namespace gltfx
