// SPDX-License-Identifier: Apache-2.0
/// The images of an asset, decoded when a plan asks for them.
#pragma once

#include <string>
#include <unordered_map>

#include "model/asset_bytes.hpp"
#include "steps/upgrade/image_cache.hpp"
#include "steps/upgrade/pictures.hpp"

namespace gltfx::upgrade {

/// Keeps references to what it is made of. Not thread-safe; `cache` may be shared with others that
/// run meanwhile.
class AssetPictures : public Pictures {
 public:
  AssetPictures(model::AssetBytes& bytes, ImageCache& cache) : bytes_(bytes), cache_(cache) {}

  const Picture& picture(std::uint64_t image) override;
  std::shared_ptr<const codec::Image> pixels(std::uint64_t image) override;
  std::uint64_t same_as(std::uint64_t image) override;

  /// Why an image could not be looked at although nothing is known to be wrong with it: no file
  /// could be read, no decoder be started, or one was ended. What was planned with such pictures
  /// depends on the moment. Empty: nothing of that kind happened.
  std::string failure() const { return failure_.empty() ? bytes_.trouble() : failure_; }

 private:
  model::AssetBytes& bytes_;
  ImageCache& cache_;
  std::string failure_;
  std::unordered_map<std::uint64_t, Picture> pictures_;
  std::unordered_map<std::uint64_t, std::uint64_t> same_;
  std::unordered_multimap<std::uint64_t, std::uint64_t> by_hash_;  ///< images that differ
};

}  // namespace gltfx::upgrade
