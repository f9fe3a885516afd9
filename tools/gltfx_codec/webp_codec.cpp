// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include <webp/decode.h>
#include <webp/demux.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include "codec/statistics.hpp"
#include "image_decode.hpp"
#include "image_encode.hpp"

namespace gltfx::codec {
namespace {

// For the planes of the decoder, and the texels.
constexpr std::uint64_t kBytesPerTexel = 8;
// For the canvas of an animation, the previous canvas, and the frame.
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

// Settings as the defaults of cwebp; one thread, so that the bytes do not depend on the machine.
// `transparent`: some alpha is 0. Colours there are kept (`exact`), which removes most of the gain
// of near-lossless encoding.
bool configure(WebPConfig& config, const Job& job, bool transparent) {
  if (WebPConfigInit(&config) == 0) return false;
  const bool near = job.quality == 0 && job.options.near_lossless < 100;
  config.exact = near && !transparent ? 0 : 1;
  config.quality = static_cast<float>(job.quality);
  if (job.quality == 0) {
    if (WebPConfigLosslessPreset(&config, 6) == 0) return false;
    config.near_lossless = static_cast<int>(job.options.near_lossless);
  }
  return WebPValidateConfig(&config) != 0;
}

bool has_transparent(const Raster& raster, std::span<const std::byte> texels) {
  if (raster.channels != 4) return false;
  for (std::size_t i = 3; i < texels.size(); i += 4) {
    if (texels[i] == std::byte{0}) return true;
  }
  return false;
}

// Expands grey to RGB, with alpha if there is alpha: WebP has no grey.
std::vector<std::byte> expand_grey(const Raster& raster, std::span<const std::byte> texels) {
  std::vector<std::byte> expanded;
  expanded.reserve(texels.size() / raster.channels * (raster.channels + 2));
  for (std::size_t i = 0; i < texels.size(); i += raster.channels) {
    expanded.insert(expanded.end(), 3, texels[i]);
    if (raster.channels == 2) expanded.push_back(texels[i + 1]);
  }
  return expanded;
}

// Says that a lossless file has an alpha channel, which libwebp leaves out where all is opaque
// (WebP Lossless Bitstream, "RIFF Header": the bit `alpha_is_used`).
void keep_alpha(std::span<std::uint8_t> file) {
  constexpr std::size_t kChunk = 12;
  constexpr std::size_t kLastOfHeader = 24;
  constexpr std::uint8_t kAlphaIsUsed = 0x10;
  if (file.size() <= kLastOfHeader || std::memcmp(file.data() + kChunk, "VP8L", 4) != 0) return;
  file[kLastOfHeader] |= kAlphaIsUsed;
}

using PicturePointer = std::unique_ptr<WebPPicture, decltype(&WebPPictureFree)>;

// Sets `picture`, which the result frees.
PicturePointer imported(WebPPicture& picture, bool lossless, const Raster& raster,
                        std::span<const std::byte> texels) {
  if (WebPPictureInit(&picture) == 0) throw std::bad_alloc();
  picture.use_argb = lossless ? 1 : 0;
  picture.width = static_cast<int>(raster.width);
  picture.height = static_cast<int>(raster.height);
  PicturePointer guard(&picture, WebPPictureFree);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(texels.data());
  const auto row = static_cast<int>(raster.width * raster.channels);
  const int taken = raster.channels == 4 ? WebPPictureImportRGBA(&picture, bytes, row)
                                         : WebPPictureImportRGB(&picture, bytes, row);
  if (taken == 0) throw std::bad_alloc();
  return guard;
}

Answer encode_still(const Job& job, const WebPConfig& config, const Raster& raster,
                    std::span<const std::byte> texels, const Output& output) {
  WebPPicture picture;
  const PicturePointer guard = imported(picture, job.quality == 0, raster, texels);
  WebPMemoryWriter file;
  WebPMemoryWriterInit(&file);
  const std::unique_ptr<WebPMemoryWriter, decltype(&WebPMemoryWriterClear)> own(
      &file, WebPMemoryWriterClear);
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &file;
  if (WebPEncode(&config, &picture) == 0) throw std::bad_alloc();
  if (raster.channels == 4) keep_alpha({file.mem, file.size});
  return hand_over(std::as_bytes(std::span(file.mem, file.size)), output);
}

// `raster`: of one frame.
Answer encode_animation(const Job& job, const WebPConfig& config, const Raster& raster,
                        std::span<const std::byte> texels, const Output& output) {
  WebPAnimEncoderOptions options;
  if (WebPAnimEncoderOptionsInit(&options) == 0) throw std::bad_alloc();
  options.anim_params.bgcolor = 0;  // transparent
  const std::unique_ptr<WebPAnimEncoder, decltype(&WebPAnimEncoderDelete)> encoder(
      WebPAnimEncoderNew(static_cast<int>(raster.width), static_cast<int>(raster.height), &options),
      WebPAnimEncoderDelete);
  if (!encoder) throw std::bad_alloc();
  const auto begin_of = [&job](std::uint64_t frame) {  // milliseconds
    return static_cast<int>((frame * job.options.frame_microseconds + 500) / 1000);
  };
  const std::size_t size = std::size_t{raster.width} * raster.height * raster.channels;
  for (std::uint32_t i = 0; i < job.options.frames; ++i) {
    WebPPicture picture;
    const PicturePointer guard = imported(picture, true, raster, texels.subspan(i * size, size));
    if (WebPAnimEncoderAdd(encoder.get(), &picture, begin_of(i), &config) == 0) {
      throw std::bad_alloc();
    }
  }
  WebPData file;
  WebPDataInit(&file);
  const std::unique_ptr<WebPData, decltype(&WebPDataClear)> own(&file, WebPDataClear);
  const int end = begin_of(job.options.frames);
  if (WebPAnimEncoderAdd(encoder.get(), nullptr, end, nullptr) == 0 ||
      WebPAnimEncoderAssemble(encoder.get(), &file) == 0) {
    throw std::bad_alloc();
  }
  return hand_over(std::as_bytes(std::span(file.bytes, file.size)), output);
}

}  // namespace

Answer decode_webp(const Job& job, std::span<const std::byte> bytes, const Output& output) {
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

Answer encode_webp(const Job& job, std::span<const std::byte> texels, const Output& output) {
  Raster raster = job.raster;
  std::vector<std::byte> expanded;
  if (raster.channels < 3) {
    expanded = expand_grey(raster, texels);
    texels = expanded;
    raster.channels += 2;
  }
  WebPConfig config;
  if (!configure(config, job, has_transparent(raster, texels))) throw std::bad_alloc();
  raster.height /= job.options.frames;
  if (raster.width > WEBP_MAX_DIMENSION || raster.height > WEBP_MAX_DIMENSION) {
    return DecodeError{ErrorKind::unsupported, "WebP is limited to 16383 texels per side."};
  }
  return job.options.frames == 1 ? encode_still(job, config, raster, texels, output)
                                 : encode_animation(job, config, raster, texels, output);
}

}  // namespace gltfx::codec
