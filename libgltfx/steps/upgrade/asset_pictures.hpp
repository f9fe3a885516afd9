// SPDX-License-Identifier: Apache-2.0
/// The images of an asset, decoded on demand for a plan.
#pragma once

#include <string>
#include <unordered_map>

#include "model/asset_bytes.hpp"
#include "steps/upgrade/image_cache.hpp"
#include "steps/upgrade/pictures.hpp"

namespace gltfx::upgrade {

/// Keeps references to its arguments. Not thread-safe; `cache` may be shared with others that run
/// at the same time.
class AssetPictures : public Pictures {
 public:
  AssetPictures(model::AssetBytes& bytes, ImageCache& cache) : bytes_(bytes), cache_(cache) {}

  const Picture& picture(std::uint64_t image) override;
  std::shared_ptr<const codec::Image> pixels(std::uint64_t image) override;
  std::uint64_t same_as(std::uint64_t image) override;

  /// Why an image could not be read although it may be valid: its file could not be read, or a
  /// decoder could not be started or was stopped. Plans with such images are not reproducible.
  /// Empty: there was no such failure.
  std::string failure() const { return failure_.empty() ? bytes_.trouble() : failure_; }

 private:
  model::AssetBytes& bytes_;
  ImageCache& cache_;
  std::string failure_;
  std::unordered_map<std::uint64_t, Picture> pictures_;
  std::unordered_map<std::uint64_t, std::uint64_t> same_;
  std::unordered_multimap<std::uint64_t, std::uint64_t> by_hash_;  ///< distinct images
};

}  // namespace gltfx::upgrade
