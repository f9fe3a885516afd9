// SPDX-License-Identifier: Apache-2.0
/// What `gltfx fix` does about findings, said of them beforehand.
#pragma once

#include <memory>

#include "schema/set.hpp"
#include "validate/validated_asset.hpp"

namespace gltfx {

/// Marks and counts the findings that one run with safe fixes removes. Where the fixes of some
/// would change something the run is rehearsed, so this takes as long as the run does.
/// `proposes`: the first marked finding of each rule gets the fix of all, where it is one of a text
/// file, as Diagnostic::fix.
void mark_fixable(validate::ValidatedAsset& validated,
                  const std::shared_ptr<const schema::Set>& schemas, bool proposes);

}  // namespace gltfx
