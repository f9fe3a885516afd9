// SPDX-License-Identifier: Apache-2.0
#include "avif_encode.hpp"

#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <avif/avif.h>

#include "avif_decode.hpp"
#include "distance.hpp"

namespace gltfx::codec {
namespace {

using AvifImage = std::unique_ptr<avifImage, decltype(&avifImageDestroy)>;
using Encoder = std::unique_ptr<avifEncoder, decltype(&avifEncoderDestroy)>;

class EncodedBytes {
 public:
  EncodedBytes() = default;
  ~EncodedBytes() { avifRWDataFree(&data_); }
  EncodedBytes(const EncodedBytes&) = delete;
  EncodedBytes& operator=(const EncodedBytes&) = delete;
  avifRWData& data() { return data_; }
  std::span<const std::byte> bytes() const {
    return std::as_bytes(std::span(data_.data, data_.size));
  }

 private:
  avifRWData data_ = AVIF_DATA_EMPTY;
};

DecodeError failed(avifResult result) {
  if (result == AVIF_RESULT_OUT_OF_MEMORY) throw std::bad_alloc();
  return {ErrorKind::unsupported, std::string("libavif: ") + avifResultToString(result) + "."};
}

// One channel of 8 or 16 bits as 8 bits.
std::byte value_at(const Raster& raster, std::span<const std::byte> texels, std::size_t at) {
  if (raster.bits == 8) return texels[at];
  std::uint16_t value = 0;
  std::memcpy(&value, texels.data() + at * sizeof value, sizeof value);
  return static_cast<std::byte>((value * 255U + 32767) / 65535);
}

// RGB with 8 bits, or RGBA if a texel is not opaque.
Texels prepare(const Raster& raster, std::span<const std::byte> texels) {
  const std::size_t count = std::size_t{raster.width} * raster.height;
  const bool has_alpha = raster.channels % 2 == 0;
  const auto alpha_at = [&](std::size_t texel) {
    return value_at(raster, texels, (texel + 1) * raster.channels - 1);
  };
  bool opaque = true;
  for (std::size_t i = 0; i < count && has_alpha && opaque; ++i) {
    opaque = alpha_at(i) == std::byte{255};
  }
  Texels result{{raster.width, raster.height, opaque ? 3U : 4U, 8}, {}};
  result.bytes.reserve(count * result.raster.channels);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t channel = raster.channels < 3 ? 0 : c;
      result.bytes.push_back(value_at(raster, texels, i * raster.channels + channel));
    }
    if (!opaque) result.bytes.push_back(alpha_at(i));
  }
  return result;
}

AvifImage planes_of(Texels& texels) {
  const Raster& raster = texels.raster;
  AvifImage image(avifImageCreate(raster.width, raster.height, 8, AVIF_PIXEL_FORMAT_YUV444),
                  avifImageDestroy);
  if (!image) throw std::bad_alloc();
  image->colorPrimaries = AVIF_COLOR_PRIMARIES_BT709;
  image->transferCharacteristics = AVIF_TRANSFER_CHARACTERISTICS_SRGB;
  image->matrixCoefficients = AVIF_MATRIX_COEFFICIENTS_BT601;
  image->yuvRange = AVIF_RANGE_FULL;
  avifRGBImage from;
  avifRGBImageSetDefaults(&from, image.get());
  from.format = raster.channels == 4 ? AVIF_RGB_FORMAT_RGBA : AVIF_RGB_FORMAT_RGB;
  from.depth = 8;
  from.pixels = reinterpret_cast<std::uint8_t*>(texels.bytes.data());
  from.rowBytes = raster.width * raster.channels;
  if (avifImageRGBToYUV(image.get(), &from) != AVIF_RESULT_OK) throw std::bad_alloc();
  return image;
}

Encoder make_encoder(std::uint32_t quality) {
  Encoder encoder(avifEncoderCreate(), avifEncoderDestroy);
  if (!encoder) throw std::bad_alloc();
  constexpr int kSpeed = 6;
  encoder->maxThreads = 1;  // a worker cannot start threads
  encoder->speed = kSpeed;
  const int quantizer = static_cast<int>((100 - quality) * AVIF_QUANTIZER_WORST_QUALITY + 50) / 100;
  encoder->minQuantizer = encoder->maxQuantizer = quantizer;
  encoder->minQuantizerAlpha = encoder->maxQuantizerAlpha = AVIF_QUANTIZER_LOSSLESS;
  return encoder;
}

}  // namespace

Answer encode_avif(const Job& job, std::span<const std::byte> texels, const Output& output) {
  const Texels source{job.raster, {texels.begin(), texels.end()}};
  Texels prepared = prepare(job.raster, texels);
  const AvifImage image = planes_of(prepared);
  const Encoder encoder = make_encoder(job.quality);
  EncodedBytes file;
  avifResult result =
      avifEncoderAddImage(encoder.get(), image.get(), 1, AVIF_ADD_IMAGE_FLAG_SINGLE);
  if (result == AVIF_RESULT_OK) result = avifEncoderFinish(encoder.get(), &file.data());
  if (result != AVIF_RESULT_OK) return failed(result);
  Job inner = job;
  inner.pixels = true;
  inner.raster = {};
  inner.max_pixels = std::uint64_t{prepared.raster.width} * prepared.raster.height;
  Texels again{prepared.raster, {}};
  Answer decoded = decode_avif(inner, file.bytes(), [&](std::uint64_t size) {
    again.bytes.resize(static_cast<std::size_t>(size));
    return std::span(again.bytes);
  });
  const auto* decoded_image = std::get_if<Image>(&decoded);
  if (decoded_image == nullptr || decoded_image->channels != prepared.raster.channels ||
      decoded_image->width != prepared.raster.width ||
      decoded_image->height != prepared.raster.height || decoded_image->bits != 8) {
    return DecodeError{ErrorKind::unsupported, "The encoder does not keep this image."};
  }
  Answer answer = hand_over(file.bytes(), output);
  if (auto* encoded = std::get_if<EncodedImage>(&answer)) {
    encoded->raster = prepared.raster;
    encoded->distance = distance(source, again, job.resize.kind);
  }
  return answer;
}

}  // namespace gltfx::codec
