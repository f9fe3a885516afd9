// SPDX-License-Identifier: Apache-2.0
#include "validate/image_phase.hpp"
#include "validate/phases.hpp"

namespace gltfx::validate {

void check_data(const Context& context, const model::ResourceData& resources, Sink& sink) {
  check_textures(context, resources, sink);
}

}  // namespace gltfx::validate
