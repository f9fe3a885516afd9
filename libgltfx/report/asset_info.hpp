// SPDX-License-Identifier: Apache-2.0
/// The facts about an asset, as the Khronos report and ours both have them.
#pragma once

#include <gltfx/report.hpp>

#include "json/writer.hpp"

namespace gltfx::report {

/// Writes `info` as one object: members of the Khronos report, in its order, those left out that
/// have nothing to say.
void write_asset_info(json::Writer& writer, const AssetInfo& info);

}  // namespace gltfx::report
