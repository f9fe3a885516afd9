// SPDX-License-Identifier: Apache-2.0
/// Fixes over and over, until none is left to do: what one of them makes may be what another fixes.
#pragma once

#include <gltfx/fix.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "edit/new_file.hpp"
#include "json/edit.hpp"
#include "pipeline/fix_plan.hpp"

namespace gltfx {

/// What all rounds came to.
struct FixedAsset {
  /// The asset after the last of them.
  validate::ValidatedAsset after;
  std::vector<FixAction> actions;                   ///< as in FixReport
  std::vector<json::Edit> edits;                    ///< of the old text
  std::map<std::string, edit::ReplacedFile> files;  ///< by path
  bool changes = false;
};

/// Bytes of assets that trials of a run validate, about.
inline constexpr std::uint64_t kTrialBytes = 32U << 20U;

/// `before` was judged by fix_judgement(). Where all fixes together bring a new finding, those that
/// do so are looked for by halves and left out, in as many trials as `trial_bytes` allow.
FixedAsset fix_in_rounds(validate::ValidatedAsset before, const FixOptions& options,
                         const std::shared_ptr<const schema::Set>& schemas,
                         std::uint64_t trial_bytes = kTrialBytes);

}  // namespace gltfx
