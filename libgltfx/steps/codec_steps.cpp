// SPDX-License-Identifier: Apache-2.0
#include "steps/codec_steps.hpp"

namespace gltfx::steps {

StepDescription images_step();
StepDescription images_step() {
  return {"images",
          "stores images in another format or size",
          "names, indices, and, without a size or quality, all texels, even transparent ones",
          "texels, if a loss is listed; metadata of image files",
          [](const ConvertOptions& options) {
            return !options.images.empty() || options.texture_size || options.shrink;
          },
          [](const StepInput& input) { return convert_images(input); },
          {target::Repair::core_images, target::Repair::rgb_images}};
}

StepDescription draco_step();
StepDescription draco_step() {
  return {"draco",
          "stores triangles and their vertices as Draco bitstreams",
          "the values of all vertices, each triangle and its winding; indices of objects except "
          "buffer views",
          "the order of vertices and triangles; vertices that no triangle uses",
          [](const ConvertOptions& options) { return options.compress == Compression::draco; },
          encode_draco};
}

}  // namespace gltfx::steps
