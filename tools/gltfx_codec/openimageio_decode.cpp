// SPDX-License-Identifier: Apache-2.0
#include "openimageio_decode.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <dlfcn.h>

#include "base/directory.hpp"
#include "foreign_header.hpp"
#include "image_decode.hpp"

namespace gltfx::codec {
namespace {

// For the image, the copy in a plugin, and the texels.
constexpr std::uint64_t kBytesPerTexel = 48;

// The useful plugins that can read from memory. The other formats are left out: ICO, SGI,
// Softimage, RLA, Cineon and HEIF.
const char* plugin_of(ImageFormat format) {
  switch (format) {
    case ImageFormat::bmp:
      return "bmp";
    case ImageFormat::tga:
      return "targa";
    case ImageFormat::gif:
      return "gif";
    case ImageFormat::tiff:
      return "tiff";
    case ImageFormat::psd:
      return "psd";
    case ImageFormat::dds:
      return "dds";
    case ImageFormat::jpeg2000:
      return "jpeg2000";
    default:
      return "pnm";
  }
}

using Input = std::unique_ptr<OIIO::ImageInput>;

// Fetches the error, because OpenImageIO prints errors that are not fetched.
std::string message_of(const Input& input) {
  std::string message = input ? input->geterror() : OIIO::geterror();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return "OpenImageIO: " + (message.empty() ? "it cannot be read" : message) + ".";
}
DecodeError refusal(const Input& input) { return {ErrorKind::malformed, message_of(input)}; }
DecodeError unusual(const char* message) { return {ErrorKind::malformed, message}; }

/// The channels that are copied from a file.
struct Selection {
  int from = 1;          ///< number of first channels of the file
  std::uint32_t to = 1;  ///< number of channels of the image
};

// The plugins for GIF and BMP give alpha to each file, the one for TGA hides it in grey files.
bool has_alpha(const OIIO::ImageSpec& spec, ImageFormat format, std::span<const std::byte> bytes) {
  if (format == ImageFormat::gif) return spec.nchannels == 4 && is_transparent(bytes);
  if (format == ImageFormat::bmp && has_unused_byte(bytes)) return false;
  if (format == ImageFormat::tga && spec.nchannels == 2) return true;
  return spec.alpha_channel >= 0 && spec.alpha_channel == std::min(spec.nchannels, 4) - 1;
}

// Two channels that are not grey and alpha become red and green, with blue 0.
Selection select(const OIIO::ImageSpec& spec, bool alpha) {
  if (spec.nchannels == 1) return {1, 1};
  if (spec.nchannels == 2) return {2, alpha ? 2U : 3U};
  return spec.nchannels > 3 && alpha ? Selection{4, 4} : Selection{3, 3};
}

// Widens rows of two channels to three, from the end, so that nothing is written over too early.
void widen(std::span<std::byte> pixels, std::size_t texels, std::size_t size) {
  for (std::size_t i = texels; i-- > 0;) {
    std::memmove(pixels.data() + i * 3 * size, pixels.data() + i * 2 * size, 2 * size);
    std::memset(pixels.data() + (i * 3 + 2) * size, 0, size);
  }
}

// Divides the colours of a texel by the alpha behind them. Integers are rounded and clamped.
template <typename T>
void divide(std::span<std::byte> pixels, std::size_t channels, double full) {
  const std::size_t colors = channels - 1;
  const std::size_t size = channels * sizeof(T);
  std::array<T, 4> values{};
  for (std::size_t at = 0; at + size <= pixels.size(); at += size) {
    std::memcpy(values.data(), pixels.data() + at, size);
    const auto alpha = static_cast<double>(values[colors]);
    if (!(alpha > 0)) continue;
    for (std::size_t c = 0; c < colors; ++c) {
      const double color = static_cast<double>(values[c]) * full / alpha;
      values[c] = std::is_floating_point_v<T> ? static_cast<T>(color)
                                              : static_cast<T>(std::min(color + 0.5, full));
    }
    std::memcpy(pixels.data() + at, values.data(), size);
  }
}

// What `oiio:UnassociatedAlpha` asks for keeps colours that a file does not multiply; those of a
// TIFF or TGA may be multiplied in the file. Those of a DDS, DXT2 and DXT4, the plugin divides.
bool is_multiplied(const OIIO::ImageSpec& spec, const Job& job, const Image& image) {
  constexpr int kMultiplied = 4;  // "attributes type" of the extension area
  if (!image.has_alpha()) return false;
  if (job.format == ImageFormat::tga) {
    return spec.get_int_attribute("targa:alpha_type") == kMultiplied;
  }
  return job.format == ImageFormat::tiff && spec.get_int_attribute("oiio:UnassociatedAlpha") == 0;
}

std::optional<DecodeError> find_obstacle(const OIIO::ImageSpec& spec, const Job& job,
                                         std::span<const std::byte> bytes) {
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0 || spec.deep) {
    return unusual("It has no texels.");
  }
  if (spec.depth > 1) return unusual("It is a volume.");
  if (spec.get_string_attribute("textureformat") == "CubeFace Environment") {
    return unusual("It is a cube map.");
  }
  if (job.format == ImageFormat::tga && has_unread_alpha(bytes)) {
    return unusual("Its alpha is in a palette or in one of 16 bits, which is not supported.");
  }
  if (job.format == ImageFormat::tiff && has_default_bits(bytes)) {
    return unusual("It does not say how many bits a sample has.");
  }
  if (spec.format.is_floating_point() && !job.floats)
    return unusual("It holds floating-point values.");
  const auto texels =
      static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height);
  if (texels > job.max_pixels) return too_many_texels();
  if (exceeds_memory(job, texels, kBytesPerTexel)) return no_memory();
  return std::nullopt;
}

Answer read(const Input& input, const OIIO::ImageSpec& spec, const Job& job, bool alpha,
            const Output& output) {
  const Selection selection = select(spec, alpha);
  Image image;
  image.width = static_cast<std::uint32_t>(spec.width);
  image.height = static_cast<std::uint32_t>(spec.height);
  image.channels = selection.to;
  image.bits = spec.format.is_floating_point() ? 32 : spec.format.size() > 1 ? 16 : 8;
  std::span<std::byte> pixels = create_pixels(image, job, output);
  std::vector<std::byte> own;
  if (pixels.empty()) {
    own.resize(static_cast<std::size_t>(*result_size(image)));
    pixels = own;
  }
  const OIIO::TypeDesc type = image.bits == 32   ? OIIO::TypeDesc::FLOAT
                              : image.bits == 16 ? OIIO::TypeDesc::UINT16
                                                 : OIIO::TypeDesc::UINT8;
  if (!input->read_image(0, 0, 0, selection.from, type, pixels.data())) return refusal(input);
  if (selection.to == 3 && selection.from == 2) {
    widen(pixels, static_cast<std::size_t>(image.texels()), image.bits / 8);
  }
  if (is_multiplied(spec, job, image)) {
    if (image.bits == 8) divide<std::uint8_t>(pixels, image.channels, 255);
    if (image.bits == 16) divide<std::uint16_t>(pixels, image.channels, 65535);
    if (image.bits == 32) divide<float>(pixels, image.channels, 1);
  }
  if (image.bits == 32) return image;
  Statistics statistics(image, job.normals);
  statistics.add(pixels);
  statistics.finish(image);
  return image;
}

// A fork does not have the threads of its parent, but keeps their locks. OpenVDB, which is not used
// here, loads log4cplus, which starts four threads. This function ends them; its header is in a
// package that OpenImageIO does not need.
void end_threads() {
  using Function = void (*)();
  void* const found = ::dlsym(RTLD_DEFAULT, "_ZN9log4cplus18shutdownThreadPoolEv");
  if (found != nullptr) reinterpret_cast<Function>(found)();
}

int count_threads() {
  DirectoryReader tasks("/proc/self/task");
  int count = 0;
  while (tasks.next() != nullptr) ++count;
  return count;
}

// OpenImageIO starts a thread even when it is to have none, and ends it at once. Without a bound: a
// fork beside a thread could wait for a lock for ever, and the client limits how long a start
// takes.
void wait_for_threads() {
  while (count_threads() > 1) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace

void prepare_openimageio() {
  end_threads();
  OIIO::attribute("threads", 1);  // a worker cannot start threads
  OIIO::attribute("exr_threads", -1);
  OIIO::attribute("plugin_searchpath", "");
  for (auto format = ImageFormat::bmp; format <= ImageFormat::pnm;
       format = static_cast<ImageFormat>(static_cast<int>(format) + 1)) {
    if (!OIIO::ImageInput::create(plugin_of(format))) OIIO::geterror();
  }
  wait_for_threads();
}

Answer decode_openimageio(const Job& job, std::span<const std::byte> bytes, const Output& output) {
  if (!is_foreign(job.format)) return unusual("Its format has another decoder.");
  OIIO::Filesystem::IOMemReader reader(const_cast<std::byte*>(bytes.data()), bytes.size());
  const Input input = OIIO::ImageInput::create(plugin_of(job.format));
  if (!input) return refusal(input);
  OIIO::ImageSpec wishes;
  wishes["oiio:UnassociatedAlpha"] = 1;
  if (!input->set_ioproxy(&reader)) return refusal(input);
  OIIO::ImageSpec spec;
  // A file with this name does not exist, so opening it as a file fails.
  if (!input->open(std::string("image.") + plugin_of(job.format), spec, wishes)) {
    return refusal(input);
  }
  Answer answer = DecodeError{};
  if (auto obstacle = find_obstacle(spec, job, bytes)) {
    answer = *std::move(obstacle);
  } else {
    answer = read(input, spec, job, has_alpha(spec, job.format, bytes), output);
  }
  input->close();
  input->geterror();
  return answer;
}

}  // namespace gltfx::codec
