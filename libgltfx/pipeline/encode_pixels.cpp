// SPDX-License-Identifier: Apache-2.0
#include "pipeline/encode_pixels.hpp"

#include <span>
#include <variant>

namespace gltfx {

Result<std::string> encode_pixels(const BakedPixels& pixels, codec::EncodedFormat format,
                                  std::uint32_t quality) {
  codec::EncodeRequest request;
  request.format = format;
  request.raster = {pixels.width, pixels.height, pixels.channels, 8};
  request.quality = quality;
  request.pixels = std::as_bytes(std::span(pixels.bytes));
  const auto encoded = codec::Client::shared().encode_image(request);
  if (const auto* error = std::get_if<codec::DecodeError>(&encoded)) {
    return Error{"the picture cannot be encoded: " + error->message};
  }
  const auto& bytes = std::get<codec::EncodedImage>(encoded).bytes;
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

}  // namespace gltfx
