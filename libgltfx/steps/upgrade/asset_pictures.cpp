// SPDX-License-Identifier: Apache-2.0
#include "steps/upgrade/asset_pictures.hpp"

#include <utility>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "steps/upgrade/image_cache.hpp"

namespace gltfx::upgrade {

const Picture& AssetPictures::picture(std::uint64_t image) {
  const auto known = pictures_.find(image);
  if (known != pictures_.end()) return known->second;
  auto bytes = bytes_.image(image);
  Picture picture;
  if (bytes) {
    const auto decoded = cache_.decode(*bytes, bytes_.origin());
    picture = decoded->picture;
    if (decoded->may_pass && failure_.empty()) {
      failure_ = fmt::format("image {}: {}", image, picture.problem);
    }
  } else {
    picture.problem = bytes.error().message;
  }
  return pictures_.emplace(image, std::move(picture)).first->second;
}

std::shared_ptr<const codec::Image> AssetPictures::pixels(std::uint64_t image) {
  auto bytes = bytes_.image(image);
  return bytes ? cache_.decode(*bytes, bytes_.origin())->pixels : nullptr;
}

std::uint64_t AssetPictures::same_as(std::uint64_t image) {
  const auto known = same_.find(image);
  if (known != same_.end()) return known->second;
  const auto bytes = bytes_.image(image);
  if (!bytes) return image;
  const std::uint64_t hash = content_hash(bytes->text());
  const auto [begin, end] = by_hash_.equal_range(hash);
  for (auto other = begin; other != end; ++other) {
    const auto its_bytes = bytes_.image(other->second);
    if (!its_bytes || its_bytes->text() != bytes->text()) continue;
    return same_[image] = other->second;
  }
  by_hash_.emplace(hash, image);
  return same_[image] = image;
}

}  // namespace gltfx::upgrade
