// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <new>

#include <webp/encode.h>

#include "image_encode.hpp"

namespace gltfx::codec {
namespace {

// As cwebp has them by default; one thread, so that the bytes do not depend on the machine.
bool configure(WebPConfig& config, std::uint32_t quality) {
  if (WebPConfigInit(&config) == 0) return false;
  config.exact = 1;
  if (quality == 0) return WebPConfigLosslessPreset(&config, 6) != 0;
  config.quality = static_cast<float>(quality);
  return WebPValidateConfig(&config) != 0;
}

}  // namespace

Answer encode_webp(const Job& job, std::span<const std::byte> texels, Output& output) {
  const Raster& raster = job.raster;
  WebPConfig config;
  WebPPicture picture;
  if (!configure(config, job.quality) || WebPPictureInit(&picture) == 0) throw std::bad_alloc();
  if (raster.width > WEBP_MAX_DIMENSION || raster.height > WEBP_MAX_DIMENSION) {
    return DecodeError{ErrorKind::malformed, "WebP holds no more than 16383 texels a side."};
  }
  picture.use_argb = job.quality == 0 ? 1 : 0;
  picture.width = static_cast<int>(raster.width);
  picture.height = static_cast<int>(raster.height);
  WebPMemoryWriter file;
  WebPMemoryWriterInit(&file);
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &file;
  const std::unique_ptr<WebPPicture, decltype(&WebPPictureFree)> guard(&picture, WebPPictureFree);
  const std::unique_ptr<WebPMemoryWriter, decltype(&WebPMemoryWriterClear)> own(
      &file, WebPMemoryWriterClear);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(texels.data());
  const auto row = static_cast<int>(raster.width * raster.channels);
  const int taken = raster.channels == 4 ? WebPPictureImportRGBA(&picture, bytes, row)
                                         : WebPPictureImportRGB(&picture, bytes, row);
  if (taken == 0 || WebPEncode(&config, &picture) == 0) throw std::bad_alloc();
  return hand_over(std::as_bytes(std::span(file.mem, file.size)), output);
}

}  // namespace gltfx::codec
