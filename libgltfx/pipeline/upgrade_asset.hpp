// SPDX-License-Identifier: Apache-2.0
/// What an upgrade would leave behind, without writing it.
#pragma once

#include <gltfx/upgrade.hpp>

#include <optional>

#include "model/opened_asset.hpp"
#include "validate/validated_asset.hpp"

namespace gltfx {

/// An upgrade that is not written.
struct Rehearsal {
  UpgradeReport report;
  /// The asset as it would be written, new images included; nothing where nothing changes, or there
  /// is a problem.
  std::optional<validate::ValidatedAsset> after;
};

/// As upgrade_file() without output; does not throw. `options` ask for no output; their schemas are
/// those that the asset was validated with. Large documents of both assets are forgotten.
Rehearsal rehearse_upgrade(validate::ValidatedAsset& asset, const UpgradeOptions& options);

/// The same for an asset that was not validated yet: that happens where it names something legacy.
UpgradeReport rehearse_upgrade(model::OpenedAsset asset, const UpgradeOptions& options);

}  // namespace gltfx
