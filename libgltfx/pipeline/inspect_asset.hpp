// SPDX-License-Identifier: Apache-2.0
/// What is in an asset, for verbs that opened it.
#pragma once

#include <gltfx/inspect.hpp>
#include <gltfx/upgrade.hpp>

#include "model/opened_asset.hpp"
#include "schema/set.hpp"

namespace gltfx {

/// As inspect_file(), without what an upgrade would do.
InspectReport inspect_asset(const model::OpenedAsset& asset, const schema::Set& schemas,
                            unsigned jobs);

/// Adds what an upgrade would do to the report on the same asset.
void add_upgrade(UpgradeReport upgrade, InspectReport& report);

}  // namespace gltfx
