// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_images.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <variant>

#include "base/fork.hpp"

namespace gltfx {
namespace {

constexpr std::size_t kMostEntries = 4096;

}  // namespace

std::optional<codec::Image> SceneImages::find(const Key& key) {
  const auto known = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& each) { return each.key == key; });
  if (known == entries_.end()) return std::nullopt;
  codec::Image image = known->image;
  image.owner = known->owner.lock();
  if (known->image.owner) bytes_ -= image.pixels.size();
  entries_.erase(known);
  if (!image.owner) return std::nullopt;
  add(key, image);
  return image;
}

void SceneImages::add(const Key& key, const codec::Image& image) {
  entries_.push_back({key, image, image.owner});
  if (image.pixels.size() > most_bytes_) {  // those of others stay
    entries_.back().image.owner.reset();
  } else {
    bytes_ += image.pixels.size();
  }
  const auto let_go = [this](Entry& entry) {
    if (entry.image.owner) bytes_ -= entry.image.pixels.size();
    entry.image.owner.reset();
  };
  if (entries_.size() > kMostEntries) {
    let_go(entries_.front());
    entries_.pop_front();
  }
  for (auto entry = entries_.begin(); bytes_ > most_bytes_; ++entry) let_go(*entry);
}

codec::ImageResult SceneImages::decode(codec::Client& client, const codec::ImageRequest& request) {
  const std::string_view text(reinterpret_cast<const char*>(request.bytes.data()),
                              request.bytes.size());
  const Key key{hash_bytes(text), request.origin, request.format, request.halvings};
  {
    const std::lock_guard lock(mutex_);
    if (auto known = find(key)) return *std::move(known);
  }
  codec::ImageResult result = client.decode_image(request);
  const auto* image = std::get_if<codec::Image>(&result);
  if (image == nullptr || !image->owner) return result;
  const std::lock_guard lock(mutex_);
  add(key, *image);
  return result;
}

SceneImages& SceneImages::shared() {
  static constinit PerProcess<SceneImages> images;
  return images.get();
}

}  // namespace gltfx
