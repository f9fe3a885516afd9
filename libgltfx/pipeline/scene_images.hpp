// SPDX-License-Identifier: Apache-2.0
/// Decoded images of one run: assets of a folder often share their textures.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>

#include "base/hash.hpp"
#include "codec/client.hpp"

namespace gltfx {

/// Keeps what was used last, within a fixed number of bytes. Any number of threads may call.
class SceneImages {
 public:
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
    codec::Image image;
  };

  std::mutex mutex_;
  std::deque<Entry> entries_;  ///< used last at the back
  std::uint64_t bytes_ = 0;    ///< of all pixels
};

}  // namespace gltfx
