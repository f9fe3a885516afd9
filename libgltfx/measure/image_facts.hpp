// SPDX-License-Identifier: Apache-2.0
/// Images: their headers, users and sizes.
#pragma once

#include <gltfx/inspect.hpp>

#include <string>
#include <vector>

#include "model/asset.hpp"
#include "model/resource_data.hpp"
#include "schema/check.hpp"

namespace gltfx::measure {

/// By index, all members except `bytes`. Adds to `problems` a sentence for each whose header cannot
/// be read.
std::vector<ImageFacts> image_facts(const model::Asset& asset, const model::ResourceData& resources,
                                    const std::vector<schema::SlotUse>& slots,
                                    std::vector<std::string>& problems);

}  // namespace gltfx::measure
