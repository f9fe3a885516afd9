// SPDX-License-Identifier: Apache-2.0
/// What an upgrade would leave behind, without writing it.
#pragma once

#include <gltfx/upgrade.hpp>

#include <optional>
#include <string>

#include "pipeline/opened_asset.hpp"

namespace gltfx {

/// The asset as upgrade_file() would write it, new images included; nothing when it would write
/// nothing, or refuse. `options` ask for no output. Lets exceptions of missing memory through.
std::optional<OpenedAsset> upgraded_asset(const std::string& path, const UpgradeOptions& options);

}  // namespace gltfx
