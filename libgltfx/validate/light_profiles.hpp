// SPDX-License-Identifier: Apache-2.0
/// Files with measured light (EXT_lights_ies).
#pragma once

#include <gltfx/report.hpp>

#include "model/resource_data.hpp"
#include "validate/context.hpp"

namespace gltfx::validate {

/// Opens what the profiles of an asset refer to and looks at the head of each: a version of LM-63
/// that readers must know, and a kind of photometry that there is. Reports what cannot be had as
/// for buffers and images.
void check_light_profiles(const Context& context, const model::ResourceData& resources, Sink& sink,
                          FileReport& report);

}  // namespace gltfx::validate
