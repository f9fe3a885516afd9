// SPDX-License-Identifier: Apache-2.0
/// Fixes over and over, until none is left to do: what one of them makes may be what another fixes.
#pragma once

#include <gltfx/fix.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "change/change.hpp"
#include "json/edit.hpp"
#include "pipeline/fix_plan.hpp"

namespace gltfx {

/// What all rounds came to.
struct FixedAsset {
  /// The asset after the last of them.
  validate::ValidatedAsset after;
  std::vector<FixAction> actions;                     ///< as in FixReport
  std::vector<json::Edit> edits;                      ///< of the old text
  std::map<std::string, change::ReplacedFile> files;  ///< by path
  std::vector<change::NewFile> new_files;
  bool changes = false;
  std::string trouble;  ///< as in PlannedFixes
};

/// Why a file may not be changed so, as half a sentence, or nothing. Its content `before` is that
/// which the first round found.
using FileGuard = std::function<std::optional<std::string>(const change::ReplacedFile& file)>;

/// `before` was judged by fix_validation(). Where all fixes together bring a new finding, those
/// that do so are looked for by halves and left out, in a bounded number of trials. Without a guard
/// any file may be changed.
FixedAsset fix_in_rounds(validate::ValidatedAsset before, const FixOptions& options,
                         const std::shared_ptr<const schema::Set>& schemas,
                         const FileGuard& guard = nullptr);

}  // namespace gltfx
