// SPDX-License-Identifier: Apache-2.0
/// `gltfx upgrade --format json`: plans and outcomes for programs.
#pragma once

#include <gltfx/upgrade.hpp>

#include <string>

#include "upgrade_text.hpp"

namespace gltfx::tool {

/// What stands before the first file.
std::string upgrade_json_begin();
/// One file; `first`: none was written before it.
std::string upgrade_json(const UpgradeReport& report, bool first);
/// What stands behind the last one, with the numbers of the run.
std::string upgrade_json_end(const UpgradeSummary& summary);

}  // namespace gltfx::tool
