// SPDX-License-Identifier: Apache-2.0
/// Which images can be decoded, and as what.
#pragma once

#include <algorithm>

#include "codec/client.hpp"
#include "image/header.hpp"
#include "model/resource_data.hpp"

namespace gltfx::model {

inline codec::ImageFormat codec_format(image::Format format) {
  switch (format) {
    case image::Format::png:
      return codec::ImageFormat::png;
    case image::Format::jpeg:
      return codec::ImageFormat::jpeg;
    case image::Format::webp:
      return codec::ImageFormat::webp;
    case image::Format::avif:
      return codec::ImageFormat::avif;
    case image::Format::ktx2:
      break;
  }
  return codec::ImageFormat::ktx2;
}

/// Whether the pixels of an image can be asked for: it has bytes and a header, and a KTX2 image has
/// texels that are known.
inline bool is_decodable(const ImageData& data) {
  return data.bytes && data.header && (!data.ktx2 || image::has_known_texels(*data.ktx2));
}

/// What to ask a decoder for an image, no more texels than its header has. Precondition:
/// is_decodable().
inline codec::ImageRequest image_request(const ResourceData& resources, std::size_t image) {
  const ImageData& data = resources.images[image];
  codec::ImageRequest request;
  request.bytes = data.bytes->view();
  request.format = codec_format(data.header->format);
  request.origin = resources.origin;
  request.max_pixels = std::min(request.max_pixels, image::texels_of(*data.header));
  return request;
}

}  // namespace gltfx::model
