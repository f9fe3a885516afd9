// SPDX-License-Identifier: Apache-2.0
/// Images: what their first bytes say, who shows them, what they cost.
#pragma once

#include <gltfx/inspect.hpp>

#include <string>
#include <vector>

#include "model/asset.hpp"
#include "model/resource_data.hpp"
#include "schema/check.hpp"

namespace gltfx::inspect {

/// By index, all but `bytes`. Adds to `problems` a sentence for each whose header cannot be read.
std::vector<ImageFacts> image_facts(const model::Asset& asset, const model::ResourceData& resources,
                                    const std::vector<schema::SlotUse>& slots,
                                    std::vector<std::string>& problems);

}  // namespace gltfx::inspect
