// SPDX-License-Identifier: Apache-2.0
/// Decoded images, and files made from them: assets of one run often share a texture map.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "container/bytes.hpp"
#include "steps/upgrade/image_job.hpp"
#include "steps/upgrade/pictures.hpp"

namespace gltfx::upgrade {

/// An image, and the pixels for `picture.image`.
struct Decoded {
  Picture picture;
  std::shared_ptr<const codec::Image> pixels;  ///< null: `picture.problem`
  bool may_pass = false;  ///< the cause of the problem may be outside of the image
};

/// The sources of a file: for each channel, the decoded image and the used channel.
struct Recipe {
  std::array<std::shared_ptr<const codec::Image>, 4> images;
  ImageJob job;  ///< its indices of images are all 0
  bool operator==(const Recipe&) const = default;
};

/// Keeps recently used images, up to a fixed number of bytes. Thread-safe.
class ImageCache {
 public:
  /// The image in these bytes, decoded unless a result from the same origin is cached. The result
  /// may change: an image that was dropped is decoded again.
  std::shared_ptr<const Decoded> decode(const container::Bytes& bytes, const Origin& origin);

  std::shared_ptr<const std::string> find(const Recipe& recipe);
  void keep(const Recipe& recipe, std::shared_ptr<const std::string> file);

  /// The cache of this process.
  static ImageCache& shared();

 private:
  struct Image {
    Origin origin;
    std::uint64_t hash = 0;
    container::Bytes bytes;
    std::shared_ptr<const Decoded> decoded;
  };
  struct File {
    Recipe recipe;
    std::shared_ptr<const std::string> bytes;
  };
  std::shared_ptr<const Decoded> known(const Origin& origin, std::uint64_t hash,
                                       std::string_view bytes);

  std::mutex mutex_;
  std::deque<Image> images_;  ///< most recently used last
  std::deque<File> files_;    ///< most recently made last
  std::uint64_t image_bytes_ = 0;
  std::uint64_t file_bytes_ = 0;
};

}  // namespace gltfx::upgrade
