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

/// Gives every image of the model its bytes, encoded or decoded on up to `jobs` threads. Images
/// that cannot be decoded stay encoded, with a note; an image without bytes makes notes fail.
void place_images(const model::ResourceData& resources, TinygltfImages form, unsigned jobs,
                  tinygltf::Model& model, Notes& notes);

/// The bytes of an image file.
struct ImageFile {
  std::string bytes;
  std::string media_type;
};

/// The file of an image: its encoded bytes, or its pixels as PNG, or as lossless WebP if that is
/// its type. Nothing when it has no bytes, or its pixels cannot be written; in the second case
/// notes fail.
std::optional<ImageFile> image_file(const tinygltf::Image& image, const Path& path, Notes& notes);

}  // namespace gltfx::interop
