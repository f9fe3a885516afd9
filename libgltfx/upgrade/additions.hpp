// SPDX-License-Identifier: Apache-2.0
/// What a plan puts behind the elements of the document's root arrays: textures with images that
/// are made anew, accessors with new bytes, and elements that are plain JSON. Pure data; indices
/// are known at once, bytes and their places only when all is settled (`upgrade/settlement.hpp`).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "json/document.hpp"
#include "upgrade/image_job.hpp"

namespace gltfx::upgrade {

/// Keeps no reference to the document it was made for.
class Additions {
 public:
  struct Accessor {
    std::string members;  ///< JSON object with all members but `bufferView` and `byteOffset`
    std::string bytes;    ///< of its elements, packed
  };
  struct Texture {
    std::uint64_t image = 0;               ///< index into the root's images
    std::optional<std::uint64_t> sampler;  ///< index into the root's samplers
  };

  Additions() = default;
  explicit Additions(const json::Document& document);

  /// A texture of a new image; equal ones are one. Gives its index in the root's textures.
  std::uint64_t add_texture(const ImageJob& job, std::optional<std::uint64_t> sampler);
  /// Gives its index in the root's accessors. Its bytes lie in a buffer view of their own.
  std::uint64_t add_accessor(Accessor accessor);
  /// An element of a root array other than textures, images, accessors, bufferViews and buffers.
  /// Gives its index there.
  std::uint64_t add_element(const std::string& array, std::string json);

  bool empty() const { return textures_.empty() && accessors_.empty() && elements_.empty(); }
  const std::vector<ImageJob>& images() const { return images_; }
  const std::vector<Texture>& textures() const { return textures_; }
  const std::vector<Accessor>& accessors() const { return accessors_; }
  const std::map<std::string, std::vector<std::string>>& elements() const { return elements_; }
  /// Elements that a root array had before.
  std::uint64_t old_count(const std::string& array) const;

 private:
  std::uint64_t add_image(const ImageJob& job);

  std::map<std::string, std::uint64_t> counts_;
  std::map<std::string, std::uint64_t> known_;  ///< places of images and textures by what they are
  std::vector<ImageJob> images_;
  std::vector<Texture> textures_;
  std::vector<Accessor> accessors_;
  std::map<std::string, std::vector<std::string>> elements_;  ///< by array
};

}  // namespace gltfx::upgrade
