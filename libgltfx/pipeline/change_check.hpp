// SPDX-License-Identifier: Apache-2.0
/// What a verb may change of an asset, judged by the comparison of assets.
#pragma once

#include <gltfx/compare.hpp>
#include <gltfx/convert.hpp>

#include <functional>
#include <string>

#include "model/opened_asset.hpp"
#include "schema/set.hpp"

namespace gltfx {

/// Changes that a verb was asked for.
struct AllowedChanges {
  CompareBounds bounds;  ///< changes within these are allowed
  std::function<bool(const Change&)> others;
};

/// Of `gltfx upgrade`: materials, textures, images, objects of extensions and what points to them.
AllowedChanges changes_of_upgrade();

/// Of `gltfx convert`, as its steps declare them. Nothing is exact where no option loses it.
AllowedChanges changes_of_conversion(const ConvertOptions& options);

/// Both texts are empty if `after` differs by nothing but what is allowed.
struct ChangeCheck {
  std::string difference;  ///< the first change that is not allowed, half a sentence
  std::string unproven;    ///< what could not be compared, half a sentence
};
/// Preconditions: both have a root object.
ChangeCheck check_changes(const model::OpenedAsset& before, const model::OpenedAsset& after,
                          const schema::Set& schemas, const AllowedChanges& allowed, unsigned jobs);

}  // namespace gltfx
