// SPDX-License-Identifier: Apache-2.0
// gltfx-codec-image: decodes PNG, JPEG, WebP, Radiance and EXR for gltfx and encodes all but
// Radiance. gltfx starts it and talks to it over a socket.
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "codec/server.hpp"
#include "codec/statistics.hpp"
#include "image_decode.hpp"
#include "image_encode.hpp"

namespace gltfx::codec {
namespace {

using OIIO::ImageInput;
using OIIO::ImageSpec;

constexpr std::size_t kBandBytes = std::size_t{1} << 20U;
// What holding a whole image takes at most, for each of its texels: interlaced and progressive ones
// are held.
constexpr std::uint64_t kBytesPerTexel = 8;

const char* plugin_name(ImageFormat format) {
  switch (format) {
    case ImageFormat::png:
      return "png";
    case ImageFormat::radiance:
      return "hdr";
    case ImageFormat::openexr:
      return "openexr";
    default:
      return "jpeg";
  }
}

Fault refusal(const Job& job, std::uint64_t texels, std::string message) {
  if (exceeds_memory(job, texels, kBytesPerTexel)) return no_memory();
  if (message.empty()) message = "It cannot be decoded.";
  return {FaultKind::malformed, std::move(message)};
}

// The first thing that a decoder complains of, without the name that it was given for the bytes.
std::string complaint(const ImageInput& input) {
  std::string message = input.geterror();
  message.resize(std::min(message.find('\n'), message.size()));
  const std::size_t name = message.find(" (\"");
  message.resize(std::min(name, message.size()));
  return message;
}

// The rows of an image, band by band.
class Reader {
 public:
  Reader(ImageInput& input, const Image& image, bool normals)
      : input_(&input),
        row_(std::size_t{image.width} * image.channels * (image.bits / 8)),
        image_(image),
        statistics_(image, normals) {}

  // False when the decoder stops. With `pixels` all rows go there.
  bool read(std::span<std::byte> pixels) {
    const std::size_t rows = std::clamp<std::size_t>(kBandBytes / row_, 1, image_.height);
    std::vector<std::byte> band(pixels.empty() ? rows * row_ : 0);
    for (std::uint32_t y = 0; y < image_.height;) {
      const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(rows, image_.height - y));
      std::byte* to = pixels.empty() ? band.data() : pixels.data() + y * row_;
      if (!read_rows(y, count, to)) return false;
      statistics_.add({to, count * row_});
      y += count;
    }
    statistics_.finish(image_);
    return true;
  }

  const Image& image() const { return image_; }

 private:
  bool read_rows(std::uint32_t first, std::uint32_t count, std::byte* to) {
    const auto begin = static_cast<int>(first);
    const OIIO::TypeDesc type = image_.bits == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8;
    return input_->read_scanlines(0, 0, begin, begin + static_cast<int>(count), 0, 0,
                                  static_cast<int>(image_.channels), type, to);
  }

  ImageInput* input_;
  std::size_t row_;
  Image image_;
  Statistics statistics_;
};

// Whether all rows of an image are held before the first one is handed out: byte 28 of a PNG tells
// whether it is interlaced.
bool is_held(const Job& job, std::span<const std::byte> bytes) {
  constexpr std::size_t kInterlace = 28;
  return job.format == ImageFormat::png && bytes.size() > kInterlace &&
         bytes[kInterlace] != std::byte{0};
}

// Pictures of light have parts and channels of many kinds: the first three or four channels count.
Answer read_floats(ImageInput& input, const Job& job, Image& image, Output& output) {
  image.bits = 32;
  const std::span<std::byte> pixels = create_pixels(image, job, output);
  if (exceeds_memory(job, image.texels(), kBytesPerTexel)) return no_memory();
  const auto channels = static_cast<int>(image.channels);
  if (!pixels.empty() &&
      !input.read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, pixels.data())) {
    return refusal(job, image.texels(), complaint(input));
  }
  return image;
}

Answer read_image(ImageInput& input, const ImageSpec& spec, const Job& job, Output& output) {
  Image image;
  image.width = static_cast<std::uint32_t>(std::max(spec.width, 0));
  image.height = static_cast<std::uint32_t>(std::max(spec.height, 0));
  image.channels = static_cast<std::uint32_t>(std::max(spec.nchannels, 0));
  image.bits = spec.format == OIIO::TypeDesc::UINT16 ? 16 : 8;
  if (holds_floats(job.format)) image.channels = std::min(image.channels, 4U);
  if (image.texels() == 0 || image.channels < 1 || image.channels > 4) {
    return Fault{FaultKind::malformed, "It has no texels."};
  }
  if (image.texels() > job.max_pixels) return too_many_texels();
  if (holds_floats(job.format)) return read_floats(input, job, image, output);
  const std::span<std::byte> pixels = create_pixels(image, job, output);
  image.doubt = complaint(input);
  Reader reader(input, image, job.normals);
  if (!reader.read(pixels)) return refusal(job, image.texels(), complaint(input));
  Image result = reader.image();
  if (result.doubt.empty()) result.doubt = complaint(input);
  return result;
}

Answer decode(const Job& job, std::span<const std::byte> bytes, Output& output) {
  if (job.format == ImageFormat::webp) return decode_webp(job, bytes, output);
  const std::unique_ptr<ImageInput> input = ImageInput::create(plugin_name(job.format));
  if (!input) return Fault{FaultKind::out_of_memory, "There is no decoder for the format."};
  OIIO::Filesystem::IOMemReader memory(const_cast<std::byte*>(bytes.data()), bytes.size());
  void* proxy = &memory;
  ImageSpec options;
  options.attribute("oiio:UnassociatedAlpha", 1);
  options.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  ImageSpec spec;
  if (!input->open(plugin_name(job.format), spec, options)) {
    return refusal(job, 0, complaint(*input));
  }
  const std::uint64_t texels = static_cast<std::uint64_t>(std::max(spec.width, 0)) *
                               static_cast<std::uint64_t>(std::max(spec.height, 0));
  if (is_held(job, bytes) && exceeds_memory(job, texels, kBytesPerTexel)) return no_memory();
  return read_image(*input, spec, job, output);
}

Answer encode(const Job& job, std::span<const std::byte> texels, Output& output) {
  switch (job.encoded) {
    case EncodedFormat::png:
      return encode_png(job, texels, output);
    case EncodedFormat::webp:
      return encode_webp(job, texels, output);
    default:
      return encode_with_plugin(job, texels, output);
  }
}

Answer serve_job(const Job& job, std::span<const std::byte> bytes, Output& output) {
  return job.task == Task::encode ? encode(job, bytes, output) : decode(job, bytes, output);
}

// Loads what the plugins load when they are first asked for: later no file can be opened.
void prepare() {
  // Workers are forked from this process: threads would not be there.
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  for (const ImageFormat format :
       {ImageFormat::png, ImageFormat::jpeg, ImageFormat::radiance, ImageFormat::openexr}) {
    static_cast<void>(ImageInput::create(plugin_name(format)));
  }
  prepare_plugins();
}

}  // namespace
}  // namespace gltfx::codec

int main() { return gltfx::codec::serve(gltfx::codec::prepare, gltfx::codec::serve_job); }
