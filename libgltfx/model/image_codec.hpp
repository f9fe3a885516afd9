// SPDX-License-Identifier: Apache-2.0
/// Decodable images and their requests.
#pragma once

#include <algorithm>

#include "codec/client.hpp"
#include "image/foreign.hpp"
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

inline codec::ImageFormat codec_format(image::ForeignFormat format) {
  switch (format) {
    case image::ForeignFormat::bmp:
      return codec::ImageFormat::bmp;
    case image::ForeignFormat::tga:
      return codec::ImageFormat::tga;
    case image::ForeignFormat::gif:
      return codec::ImageFormat::gif;
    case image::ForeignFormat::tiff:
      return codec::ImageFormat::tiff;
    case image::ForeignFormat::psd:
      return codec::ImageFormat::psd;
    case image::ForeignFormat::dds:
      return codec::ImageFormat::dds;
    case image::ForeignFormat::jpeg2000:
      return codec::ImageFormat::jpeg2000;
    case image::ForeignFormat::pnm:
      break;
  }
  return codec::ImageFormat::pnm;
}

/// Whether the pixels of an image can be decoded: it has bytes and a header, and a KTX2 image has
/// supported texels.
inline bool is_decodable(const ImageData& data) {
  return data.bytes && data.header && (!data.ktx2 || image::has_known_texels(*data.ktx2));
}

/// The request to decode an image, with at most as many texels as in its header. Precondition:
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
