// SPDX-License-Identifier: Apache-2.0
/// Decoded images of one run: assets of a folder often share their textures, as frames of a clip
/// do.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>

#include "base/hash.hpp"
#include "codec/client.hpp"

namespace gltfx {

/// Keeps what was used last, within a fixed number of bytes, and knows what others keep. Any number
/// of threads may call.
class SceneImages {
 public:
  explicit SceneImages(std::uint64_t most_bytes = std::uint64_t{128} << 20U)
      : most_bytes_(most_bytes) {}

  /// Decodes an image unless the same bytes of the same origin are known with the same detail.
  codec::ImageResult decode(codec::Client& client, const codec::ImageRequest& request);

  /// The one that this process shares.
  static SceneImages& shared();

 private:
  struct Key {
    Hash128 bytes;
    Origin origin;
    codec::ImageFormat format;
    std::uint32_t halvings;
    bool operator==(const Key&) const = default;
  };
  struct Entry {
    Key key;
    codec::Image image;  ///< without an owner if the pixels are not kept
    std::weak_ptr<const void> owner;
  };

  std::optional<codec::Image> find(const Key& key);
  void add(const Key& key, const codec::Image& image);

  const std::uint64_t most_bytes_;
  std::mutex mutex_;
  std::deque<Entry> entries_;  ///< used last at the back
  std::uint64_t bytes_ = 0;    ///< of all pixels that are kept
};

}  // namespace gltfx
