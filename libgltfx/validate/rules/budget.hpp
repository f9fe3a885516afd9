// SPDX-License-Identifier: Apache-2.0
/// Limits that the user sets: texture sizes, triangles, draw calls, bytes.
#pragma once

#include <gltfx/report.hpp>

#include <vector>

#include "model/resource_data.hpp"
#include "validate/context.hpp"

namespace gltfx::validate {

/// Reports what exceeds the budgets of the options.
void check_budgets(const Context& context, const model::ResourceData& resources,
                   const AssetInfo& info, const std::vector<ResourceInfo>& listed, Sink& sink);

}  // namespace gltfx::validate
