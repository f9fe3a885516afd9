// SPDX-License-Identifier: Apache-2.0
/// What `gltfx fix` would do about findings.
#pragma once

#include <gltfx/validate.hpp>

#include <memory>
#include <string>
#include <vector>

#include "json/edit.hpp"
#include "rules/validated_asset.hpp"

namespace gltfx {

/// Marks and counts the findings for which a safe fix has a change. Whether `gltfx fix` makes it is
/// not found out: it leaves a fix that brings a new finding. `asked` is what the asset was
/// validated with. With `propose_fixes` the first marked finding of each rule gets the fix of all,
/// where it is one of a text file and brings no new finding, as Diagnostic::fix.
void mark_fixable(validate::ValidatedAsset& validated, const ValidateOptions& asked);

/// Edits of the text of an asset, as a finding proposes them.
std::shared_ptr<const ProposedFix> proposed_fix(std::string description,
                                                const model::OpenedAsset& asset,
                                                const std::vector<json::Edit>& edits);

}  // namespace gltfx
