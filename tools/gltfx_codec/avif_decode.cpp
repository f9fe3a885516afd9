// SPDX-License-Identifier: Apache-2.0
#include "avif_decode.hpp"

#include <memory>
#include <new>
#include <string>
#include <vector>

#include <avif/avif.h>

#include "image_decode.hpp"

namespace gltfx::codec {
namespace {

// For 16-bit planes, the planes of the decoder, and the texels.
constexpr std::uint64_t kBytesPerTexel = 32;

using Decoder = std::unique_ptr<avifDecoder, decltype(&avifDecoderDestroy)>;

DecodeError refusal(avifResult result) {
  if (result == AVIF_RESULT_OUT_OF_MEMORY) return no_memory();
  return {ErrorKind::malformed, std::string("libavif: ") + avifResultToString(result) + "."};
}

Decoder make_decoder(std::span<const std::byte> bytes) {
  Decoder decoder(avifDecoderCreate(), avifDecoderDestroy);
  if (!decoder) throw std::bad_alloc();
  decoder->maxThreads = 1;  // a worker cannot start threads
  decoder->ignoreExif = decoder->ignoreXMP = AVIF_TRUE;
  decoder->strictFlags = AVIF_STRICT_DISABLED;  // as in browsers: libgltfx/image has its own checks
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  if (avifDecoderSetIOMemory(decoder.get(), data, bytes.size()) != AVIF_RESULT_OK) {
    throw std::bad_alloc();
  }
  return decoder;
}

}  // namespace

Answer decode_avif(const Job& job, std::span<const std::byte> bytes, const Output& output) {
  const Decoder decoder = make_decoder(bytes);
  if (const avifResult result = avifDecoderParse(decoder.get()); result != AVIF_RESULT_OK) {
    return refusal(result);
  }
  const avifImage& parsed = *decoder->image;
  Image image;
  image.width = parsed.width;
  image.height = parsed.height;
  image.channels = decoder->alphaPresent != AVIF_FALSE ? 4 : 3;
  image.bits = parsed.depth > 8 ? 16 : 8;
  if (image.texels() == 0) return refusal(AVIF_RESULT_BMFF_PARSE_FAILED);
  if (image.texels() > job.max_pixels) return too_many_texels();
  if (exceeds_memory(job, image.texels(), kBytesPerTexel)) return no_memory();
  if (const avifResult result = avifDecoderNextImage(decoder.get()); result != AVIF_RESULT_OK) {
    return refusal(result);
  }
  if (parsed.width != image.width || parsed.height != image.height) {
    return refusal(AVIF_RESULT_ISPE_SIZE_MISMATCH);
  }
  std::span<std::byte> pixels = create_pixels(image, job, output);
  std::vector<std::byte> own;
  if (pixels.empty()) {
    own.resize(static_cast<std::size_t>(*result_size(image)));
    pixels = own;
  }
  avifRGBImage to;
  avifRGBImageSetDefaults(&to, decoder->image);
  to.format = image.channels == 4 ? AVIF_RGB_FORMAT_RGBA : AVIF_RGB_FORMAT_RGB;
  to.depth = image.bits;
  to.pixels = reinterpret_cast<std::uint8_t*>(pixels.data());
  to.rowBytes = image.width * image.channels * (image.bits / 8);
  if (const avifResult result = avifImageYUVToRGB(decoder->image, &to); result != AVIF_RESULT_OK) {
    return refusal(result);
  }
  Statistics statistics(image, job.normals);
  statistics.add(pixels);
  statistics.finish(image);
  return image;
}

}  // namespace gltfx::codec
