// SPDX-License-Identifier: Apache-2.0
/// Images of tinygltf: from encoded bytes, and back.
#pragma once

#include <optional>
#include <string>

#include "interop/notes.hpp"
#include "model/resource_data.hpp"

namespace tinygltf {
struct Image;
}

namespace gltfx::interop {

/// Gives every image of the model its bytes, encoded or decoded on up to `jobs` threads. What
/// cannot be decoded stays encoded, with a note; an image without bytes makes notes fail.
void place_images(const model::ResourceData& resources, TinygltfImages form, unsigned jobs,
                  tinygltf::Model& model, Notes& notes);

/// The bytes of an image file.
struct ImageFile {
  std::string bytes;
  std::string media_type;
};

/// The file that holds what the image holds: as it is, or its pixels as PNG, or as WebP without
/// loss where it says that it is one. Nothing when it has no bytes or they are no pixels that can
/// be written; then notes fail, unless there are none.
std::optional<ImageFile> image_file(const tinygltf::Image& image, const Path& path, Notes& notes);

}  // namespace gltfx::interop
