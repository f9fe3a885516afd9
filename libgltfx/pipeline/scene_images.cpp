// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_images.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <variant>

#include "base/fork.hpp"

namespace gltfx {
namespace {

constexpr std::uint64_t kMostPixelBytes = std::uint64_t{128} << 20U;

}  // namespace

codec::ImageResult SceneImages::decode(codec::Client& client, const codec::ImageRequest& request) {
  const std::string_view text(reinterpret_cast<const char*>(request.bytes.data()),
                              request.bytes.size());
  const Key key{hash_bytes(text), request.origin, request.format, request.halvings};
  {
    const std::lock_guard lock(mutex_);
    const auto known = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& each) { return each.key == key; });
    if (known != entries_.end()) {
      std::rotate(known, known + 1, entries_.end());
      return entries_.back().image;
    }
  }
  codec::ImageResult result = client.decode_image(request);
  const auto* image = std::get_if<codec::Image>(&result);
  if (image == nullptr || image->pixels.size() > kMostPixelBytes) return result;
  const std::lock_guard lock(mutex_);
  bytes_ += image->pixels.size();
  entries_.push_back({key, *image});
  while (bytes_ > kMostPixelBytes) {
    bytes_ -= entries_.front().image.pixels.size();
    entries_.pop_front();
  }
  return result;
}

SceneImages& SceneImages::shared() {
  static constinit PerProcess<SceneImages> images;
  return images.get();
}

}  // namespace gltfx
