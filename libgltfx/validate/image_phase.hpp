// SPDX-License-Identifier: Apache-2.0
/// Images as far as their headers go, and the textures that use them.
#pragma once

#include "validate/context.hpp"
#include "validate/phases.hpp"

namespace gltfx::validate {

/// Opens every image, reads its header and reports what is wrong with it. Buffers have been loaded.
void load_images(const Context& context, Sink& sink, FileReport& report, Resources& resources);

/// Textures whose image has a format that is not theirs.
void check_textures(const Context& context, const model::ResourceData& data, Sink& sink);

}  // namespace gltfx::validate
