// SPDX-License-Identifier: Apache-2.0
/// Decoded images, and files that were made of them: assets of one run often share a map.
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

/// A picture, and its pixels behind `picture.image`.
struct Decoded {
  Picture picture;
  std::shared_ptr<const codec::Image> pixels;  ///< null: `picture.problem`
  bool may_pass = false;                       ///< the problem need not lie in the image
};

/// What a file was made of: for each channel the decoded image and what was taken of it.
struct Recipe {
  std::array<std::shared_ptr<const codec::Image>, 4> images;
  ImageJob job;  ///< its indices of images are all 0
  bool operator==(const Recipe&) const = default;
};

/// Keeps what was used last, within a fixed number of bytes. Any number of threads may call.
class ImageCache {
 public:
  /// The image behind these bytes, decoded unless that is known from the same origin. Not the same
  /// for ever: an image that was forgotten is decoded again.
  std::shared_ptr<const Decoded> decode(const container::Bytes& bytes, const Origin& origin);

  std::shared_ptr<const std::string> find(const Recipe& recipe);
  void keep(const Recipe& recipe, std::shared_ptr<const std::string> file);

  /// The one that this process shares.
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
  std::deque<Image> images_;  ///< used last at the back
  std::deque<File> files_;    ///< made last at the back
  std::uint64_t image_bytes_ = 0;
  std::uint64_t file_bytes_ = 0;
};

}  // namespace gltfx::upgrade
