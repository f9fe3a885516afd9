// SPDX-License-Identifier: Apache-2.0
/// What fixes of rules come to in one asset.
#pragma once

#include <gltfx/fix.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "json/edit.hpp"
#include "model/opened_asset.hpp"
#include "rules/fix.hpp"
#include "rules/validated_asset.hpp"
#include "schema/set.hpp"

namespace gltfx {

/// What is asked of the asset.
ValidateOptions asked_of(const model::OpenedAsset& asset, const FixOptions& options);

/// How the verb judges: all that headers of images tell, hints too, but for what the asset may
/// suppress.
ValidateOptions fix_validation(const std::shared_ptr<const schema::Set>& schemas,
                               const ValidateOptions& asked);

/// Changes of one asset by fixes, and which sites they are about, by position.
struct PlannedFixes {
  change::Change change;
  std::vector<bool> fixed;
  /// A value with which the fix is one with others that share it, or json::kNoNode.
  std::vector<json::NodeId> shared;
  std::string obstacle;  ///< why there are no changes; a sentence without stop, empty: none is due
  std::map<std::size_t, std::string>
      left;  ///< sites that cannot be fixed, with the reason, half a sentence
  /// Why nothing must be written, half a sentence: the system or the installation lacks what a fix
  /// needs; empty: no such reason.
  std::string trouble;
};

/// `sites` are those of the asset as it is; those that are `wanted`, by position, are to be fixed.
/// Only fixes of the first stage that has some are made. `content_bytes`: see Fixing. `options` say
/// which rules may have unsafe fixes.
PlannedFixes plan_fixes(const model::OpenedAsset& asset, const validate::Sites& sites,
                        const schema::Set& schemas, const std::vector<bool>& wanted,
                        std::uint64_t content_bytes, const FixOptions& options);

/// Whether fixes of a rule may be unsafe.
bool allows_unsafe(const FixOptions& options, Code code);

/// Which sites, by position, are not among those that the asset has `after` edits of its text.
/// Those that were `fixed` are gone even if the same is found elsewhere now.
std::vector<bool> sites_gone(const validate::Sites& sites, const validate::Sites& after,
                             const std::vector<json::Edit>& edits, const std::vector<bool>& fixed);

/// Marks those sites that are fixed where they are `now`, after edits of their text.
void mark_fixed(const validate::Sites& sites, const std::vector<json::Edit>& edits,
                const validate::Sites& now, const std::vector<bool>& fixed,
                std::vector<bool>& marked);

/// RFC 6901 pointer to what a site marks, also to a number of an array; "": the file as a whole.
std::string pointer_to(const json::Document& document, const validate::Site& site);

}  // namespace gltfx
