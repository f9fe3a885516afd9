// SPDX-License-Identifier: Apache-2.0
#include "transcode.hpp"

#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "distance.hpp"
#include "image_decode.hpp"
#include "image_encode.hpp"
#include "resize.hpp"

namespace gltfx::codec {

namespace {

Answer decode(const Job& job, std::span<const std::byte> bytes, const Output& output) {
  switch (job.format) {
    case ImageFormat::png:
      return decode_png(job, bytes, output);
    case ImageFormat::jpeg:
      return decode_jpeg(job, bytes, output);
    case ImageFormat::webp:
      return decode_webp(job, bytes, output);
    case ImageFormat::ktx2:
      return decode_ktx2(job, bytes, output);
    case ImageFormat::radiance:
      return decode_radiance(job, bytes, output);
    default:
      return decode_exr(job, bytes, output);
  }
}

Answer encode(const Job& job, std::span<const std::byte> texels, const Output& output) {
  switch (job.encoded) {
    case EncodedFormat::png:
      return encode_png(job, texels, output);
    case EncodedFormat::webp:
      return encode_webp(job, texels, output);
    case EncodedFormat::jpeg:
      return encode_jpeg(job, texels, output);
    case EncodedFormat::ktx2:
      return encode_ktx2(job, texels, output);
    default:
      return encode_exr(job, texels, output);
  }
}

DecodeError refused(const char* message) { return {ErrorKind::unsupported, message}; }

/// A decoded image and its texels.
struct Decoded {
  Image image;
  Texels texels;
};
using DecodedResult = std::variant<Decoded, DecodeError>;

// All texels of a file, or texels that another worker has decoded.
DecodedResult texels_of(const Job& job, std::span<const std::byte> bytes) {
  Decoded decoded;
  if (job.raster.width != 0) {
    decoded.texels = {job.raster, {bytes.begin(), bytes.end()}};
    return decoded;
  }
  Job inner = job;
  inner.pixels = true;
  inner.normals = false;  // no statistics of these texels are used
  Answer answer = decode(inner, bytes, [&](std::uint64_t size) {
    decoded.texels.bytes.resize(static_cast<std::size_t>(size));
    return std::span(decoded.texels.bytes);
  });
  if (auto* error = std::get_if<DecodeError>(&answer)) return std::move(*error);
  decoded.image = std::move(*std::get_if<Image>(&answer));
  const Image& image = decoded.image;
  decoded.texels.raster = {image.width, image.height, image.channels, image.bits};
  return decoded;
}

// KHR_texture_basisu requires multiples of 4.
std::uint32_t multiple_of_four(std::uint32_t side, std::uint32_t most) {
  const std::uint32_t rounded = (side / 4 + (side % 4 >= 2 ? 1 : 0)) * 4;
  return std::max(most != 0 && rounded > most ? most / 4 * 4 : rounded, 4U);
}

void change_size(Texels& texels, const Job& job, bool blocks) {
  Size size = limited_size(texels.raster, job.resize);
  if (blocks) {
    size = {multiple_of_four(size.width, job.resize.max_side),
            multiple_of_four(size.height, job.resize.max_side)};
  }
  if (size == Size{texels.raster.width, texels.raster.height}) return;
  texels = resize(texels.raster, texels.bytes, size, job.resize);
}

Answer hand_over_pixels(Decoded decoded, const Job& job, const Output& output) {
  const Raster& raster = decoded.texels.raster;
  Image image;
  image.width = raster.width;
  image.height = raster.height;
  image.channels = raster.channels;
  image.bits = raster.bits;
  image.doubt = std::move(decoded.image.doubt);
  const std::span<std::byte> to = create_pixels(image, job, output);
  std::memcpy(to.data(), decoded.texels.bytes.data(), decoded.texels.bytes.size());
  if (image.bits == 32) return image;
  Statistics statistics(image, job.normals);
  statistics.add(to);
  statistics.finish(image);
  return image;
}

// The form of texels in an encoded file: WebP and KTX2 have no grey.
Raster raster_in_file(const Job& job, Raster raster) {
  const bool grey = job.encoded != EncodedFormat::webp && job.encoded != EncodedFormat::ktx2;
  if (!grey && raster.channels < 3) raster.channels += 2;
  raster.height /= job.options.frames;
  return raster;
}

// Whether the encoding must be lossless.
bool keeps_all(const Job& job) {
  return job.encoded == EncodedFormat::png || job.encoded == EncodedFormat::exr ||
         (job.encoded == EncodedFormat::webp && job.quality == 0 &&
          job.options.near_lossless == 100);
}

// Drops an alpha that is 1 everywhere. False if it is not.
bool drop_alpha(Texels& texels) {
  const std::size_t channels = texels.raster.channels;
  const std::size_t count = texels.bytes.size() / channels;
  for (std::size_t i = 1; i <= count; ++i) {
    if (texels.bytes[i * channels - 1] != std::byte{255}) return false;
  }
  std::size_t to = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c + 1 < channels; ++c)
      texels.bytes[to++] = texels.bytes[i * channels + c];
  }
  texels.bytes.resize(to);
  --texels.raster.channels;
  return true;
}

void halve_bits(Texels& texels) {
  for (std::size_t i = 0; i * 2 < texels.bytes.size(); ++i) {
    std::uint16_t value = 0;
    std::memcpy(&value, texels.bytes.data() + i * 2, sizeof value);
    texels.bytes[i] = static_cast<std::byte>((value * 255U + 32767) / 65535);
  }
  texels.bytes.resize(texels.bytes.size() / 2);
  texels.raster.bits = 8;
}

// Converts texels to a form that the format supports, if the request permits the loss.
std::optional<DecodeError> fit(Texels& texels, const Job& job) {
  if (texels.raster.bits == 16 && !format_holds(job, texels.raster) && !keeps_all(job)) {
    halve_bits(texels);
  }
  const bool alpha = texels.raster.channels % 2 == 0;
  if (job.encoded == EncodedFormat::jpeg && texels.raster.bits == 8 && alpha &&
      !drop_alpha(texels)) {
    return refused("JPEG does not support alpha.");
  }
  if (job.encoded == EncodedFormat::ktx2 && texels.raster.bits == 8 && alpha) drop_alpha(texels);
  if (!format_holds(job, texels.raster)) {
    return refused("The format does not support such images.");
  }
  return std::nullopt;
}

// Whether the texels are equal if the second ones may be RGB instead of grey, or lack an alpha that
// is opaque everywhere.
bool same_texels(const Texels& a, const Texels& b) {
  const std::size_t count = std::size_t{a.raster.width} * a.raster.height;
  const std::size_t size = a.raster.bits / 8;
  if (a.raster.width != b.raster.width || a.raster.height != b.raster.height ||
      a.raster.bits != b.raster.bits) {
    return false;
  }
  if (a.raster.channels == b.raster.channels) return a.bytes == b.bytes;
  if (size != 1) return false;
  const auto channel = [](const Texels& texels, std::size_t texel, std::size_t c) {
    const std::size_t channels = texels.raster.channels;
    if (c == 3) {
      return channels % 2 == 0 ? texels.bytes[texel * channels + channels - 1] : std::byte{255};
    }
    return texels.bytes[texel * channels + (channels < 3 ? 0 : c)];
  };
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      if (channel(a, i, c) != channel(b, i, c)) return false;
    }
  }
  return true;
}

ImageFormat format_of(EncodedFormat format) {
  switch (format) {
    case EncodedFormat::png:
      return ImageFormat::png;
    case EncodedFormat::jpeg:
      return ImageFormat::jpeg;
    case EncodedFormat::webp:
      return ImageFormat::webp;
    case EncodedFormat::ktx2:
      return ImageFormat::ktx2;
    case EncodedFormat::avif:
      return ImageFormat::avif;
    case EncodedFormat::exr:
      break;
  }
  return ImageFormat::openexr;
}

// The texels of a file that was encoded from texels of the size of `raster`; nothing if it cannot
// be decoded.
std::optional<Texels> decode_again(const Job& job, std::span<const std::byte> file,
                                   const Raster& raster) {
  Job inner = job;
  inner.raster = {};
  inner.max_pixels = std::uint64_t{raster.width} * raster.height;
  inner.format = format_of(job.encoded);
  DecodedResult again = texels_of(inner, file);
  auto* decoded = std::get_if<Decoded>(&again);
  const bool same_size = decoded != nullptr && decoded->texels.raster.width == raster.width &&
                         decoded->texels.raster.height == raster.height;
  return same_size ? std::optional(std::move(decoded->texels)) : std::nullopt;
}

// Encodes texels and compares the result with `wanted`, the same texels before fit().
Answer encode_compared(const Job& job, const Texels& texels, const Texels& wanted,
                       const Output& output) {
  Job inner = job;
  inner.raster = texels.raster;
  std::span<const std::byte> file;
  Answer answer = encode(inner, texels.bytes, [&](std::uint64_t size) {
    const std::span<std::byte> to = output(size);
    file = to;
    return to;
  });
  auto* encoded = std::get_if<EncodedImage>(&answer);
  if (encoded == nullptr) return answer;
  const auto again = decode_again(job, file, texels.raster);
  if (!again || (keeps_all(job) && !same_texels(texels, *again))) {
    return refused("The encoder does not keep all texels of this image.");
  }
  encoded->raster = raster_in_file(job, texels.raster);
  if (!keeps_all(job)) encoded->distance = distance(wanted, *again, job.resize.kind);
  return answer;
}

Answer transcode(const Job& job, std::span<const std::byte> bytes, const Output& output) {
  DecodedResult result = texels_of(job, bytes);
  auto* decoded = std::get_if<Decoded>(&result);
  if (decoded == nullptr) return std::move(*std::get_if<DecodeError>(&result));
  const std::string& doubt = decoded->image.doubt;
  if (!doubt.empty()) return DecodeError{ErrorKind::malformed, doubt};
  Texels& texels = decoded->texels;
  const Raster source = texels.raster;
  change_size(texels, job, job.encoded == EncodedFormat::ktx2);
  std::optional<Texels> wide;
  if (texels.raster.bits == 16 && !keeps_all(job)) wide = texels;
  if (auto error = fit(texels, job)) return *std::move(error);
  Answer answer = encode_compared(job, texels, wide ? *wide : texels, output);
  if (auto* encoded = std::get_if<EncodedImage>(&answer)) encoded->source = source;
  return answer;
}

}  // namespace

Answer serve_image(const Job& job, std::span<const std::byte> bytes, const Output& output) {
  if (job.task == Task::transcode) return transcode(job, bytes, output);
  if (job.task == Task::encode) {
    Answer answer = encode(job, bytes, output);
    if (auto* encoded = std::get_if<EncodedImage>(&answer)) {
      encoded->source = job.raster;
      encoded->raster = raster_in_file(job, job.raster);
    }
    return answer;
  }
  const bool whole = job.raster.width == 0 && (job.resize.max_side == 0 || !job.pixels);
  if (whole) return decode(job, bytes, output);
  DecodedResult result = texels_of(job, bytes);
  auto* decoded = std::get_if<Decoded>(&result);
  if (decoded == nullptr) return std::move(*std::get_if<DecodeError>(&result));
  change_size(decoded->texels, job, false);
  return hand_over_pixels(std::move(*decoded), job, output);
}

}  // namespace gltfx::codec
