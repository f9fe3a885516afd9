// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <memory>
#include <new>
#include <string>

#include <webp/decode.h>
#include <webp/demux.h>

#include "codec/statistics.hpp"
#include "image_decode.hpp"

namespace gltfx::codec {
namespace {

// The planes that it is decoded from, and the texels.
constexpr std::uint64_t kBytesPerTexel = 8;
// The canvas of an animation, the one before, and the frame.
constexpr std::uint64_t kBytesPerAnimatedTexel = 16;

const std::uint8_t* data_of(std::span<const std::byte> bytes) {
  return reinterpret_cast<const std::uint8_t*>(bytes.data());
}

DecodeError refusal(VP8StatusCode status) {
  switch (status) {
    case VP8_STATUS_OUT_OF_MEMORY:
      return no_memory();
    case VP8_STATUS_UNSUPPORTED_FEATURE:
      return {ErrorKind::malformed, "It has an unsupported feature."};
    case VP8_STATUS_SUSPENDED:
    case VP8_STATUS_NOT_ENOUGH_DATA:
      return {ErrorKind::malformed, "Its data is truncated."};
    default:
      return {ErrorKind::malformed, "Its bitstream is corrupt."};
  }
}

Answer look_at(Image image, const Job& job, std::span<const std::byte> texels) {
  Statistics statistics(image, job.normals);
  statistics.add(texels);
  statistics.finish(image);
  return image;
}

// The first frame on the canvas of an animation.
Answer decode_animation(Image image, const Job& job, std::span<const std::byte> bytes,
                        std::span<std::byte> pixels) {
  WebPAnimDecoderOptions options;
  WebPAnimDecoderOptionsInit(&options);
  options.color_mode = MODE_RGBA;
  const WebPData data{data_of(bytes), bytes.size()};
  const std::unique_ptr<WebPAnimDecoder, decltype(&WebPAnimDecoderDelete)> decoder(
      WebPAnimDecoderNew(&data, &options), WebPAnimDecoderDelete);
  std::uint8_t* texels = nullptr;
  int time = 0;
  if (!decoder || WebPAnimDecoderGetNext(decoder.get(), &texels, &time) == 0) {
    return refusal(VP8_STATUS_BITSTREAM_ERROR);
  }
  const auto size = static_cast<std::size_t>(image.texels() * image.channels);
  const std::span<const std::byte> all(reinterpret_cast<const std::byte*>(texels), size);
  if (!pixels.empty()) std::memcpy(pixels.data(), texels, size);
  return look_at(std::move(image), job, all);
}

Answer decode_still(Image image, const Job& job, std::span<const std::byte> bytes,
                    std::span<std::byte> pixels) {
  WebPDecoderConfig config;
  if (WebPInitDecoderConfig(&config) == 0) return no_memory();
  const auto size = static_cast<std::size_t>(image.texels() * image.channels);
  std::unique_ptr<std::byte[]> own;
  if (pixels.empty()) {
    own.reset(new std::byte[size]);
    pixels = {own.get(), size};
  }
  config.output.colorspace = image.channels == 4 ? MODE_RGBA : MODE_RGB;
  config.output.is_external_memory = 1;
  config.output.u.RGBA.rgba = reinterpret_cast<std::uint8_t*>(pixels.data());
  config.output.u.RGBA.stride = static_cast<int>(image.width * image.channels);
  config.output.u.RGBA.size = size;
  const VP8StatusCode status = WebPDecode(data_of(bytes), bytes.size(), &config);
  WebPFreeDecBuffer(&config.output);
  if (status != VP8_STATUS_OK) return refusal(status);
  return look_at(std::move(image), job, pixels);
}

}  // namespace

Answer decode_webp(const Job& job, std::span<const std::byte> bytes, Output& output) {
  WebPBitstreamFeatures features;
  const VP8StatusCode status = WebPGetFeatures(data_of(bytes), bytes.size(), &features);
  if (status != VP8_STATUS_OK) return refusal(status);
  Image image;
  image.width = static_cast<std::uint32_t>(features.width);
  image.height = static_cast<std::uint32_t>(features.height);
  const bool animated = features.has_animation != 0;
  image.channels = animated || features.has_alpha != 0 ? 4 : 3;
  if (image.texels() == 0) return refusal(VP8_STATUS_BITSTREAM_ERROR);
  if (image.texels() > job.max_pixels) return too_many_texels();
  const std::uint64_t needs = animated ? kBytesPerAnimatedTexel : kBytesPerTexel;
  if (exceeds_memory(job, image.texels(), needs)) return no_memory();
  const std::span<std::byte> pixels = create_pixels(image, job, output);
  return animated ? decode_animation(std::move(image), job, bytes, pixels)
                  : decode_still(std::move(image), job, bytes, pixels);
}

}  // namespace gltfx::codec
