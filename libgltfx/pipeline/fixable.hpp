// SPDX-License-Identifier: Apache-2.0
/// What `gltfx fix` does about findings, said of them beforehand.
#pragma once

#include <gltfx/validate.hpp>

#include "validate/validated_asset.hpp"

namespace gltfx {

/// Marks and counts the findings that one run with safe fixes removes, of those that `asked` asks
/// for: those the asset was validated with. Where the fixes of some would change something the run
/// is rehearsed, so this takes as long as the run does. With `propose_fixes` the first marked
/// finding of each rule gets the fix of all, where it is one of a text file, as Diagnostic::fix.
void mark_fixable(validate::ValidatedAsset& validated, const ValidateOptions& asked);

}  // namespace gltfx
