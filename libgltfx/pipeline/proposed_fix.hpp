// SPDX-License-Identifier: Apache-2.0
/// What `gltfx upgrade` would do, said beside the finding that asks for it.
#pragma once

#include <gltfx/validate.hpp>

#include "validate/validated_asset.hpp"

namespace gltfx {

/// Gives the first finding about an extension that was replaced the edits that bring all objects to
/// their successors for which that is safe. Nothing where the text has errors, the new text would
/// have an error that the old one has not, or the asset is binary.
void propose_fix(validate::ValidatedAsset& asset, const ValidateOptions& options);

}  // namespace gltfx
