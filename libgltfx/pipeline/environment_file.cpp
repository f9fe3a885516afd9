// SPDX-License-Identifier: Apache-2.0
#include "pipeline/environment_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <variant>

#include <fmt/format.h>

#include "base/fork.hpp"
#include "base/hash.hpp"
#include "base/text.hpp"
#include "codec/client.hpp"
#include "container/container.hpp"
#include "container/content.hpp"
#include "image/foreign.hpp"
#include "image/header.hpp"
#include "model/image_codec.hpp"
#include "render/tonemap.hpp"

namespace gltfx {
namespace {

constexpr std::uint32_t kWidest = 4096;

using SharedEnvironment = std::shared_ptr<const render::EnvironmentImage>;

// By the first bytes; by the ending if they are unknown, so that the decoder names the defect.
std::optional<codec::ImageFormat> format_of(const std::string& path,
                                            const container::Bytes& bytes) {
  const image::Sniffed sniffed = image::sniff(bytes.view());
  if (sniffed.known) return model::codec_format(sniffed.format);
  const std::string_view type = container::name_content(bytes.text()).media_type;
  const std::string ending = ending_of(path);
  if (type == "image/vnd.radiance") return codec::ImageFormat::radiance;
  if (type == "image/x-exr") return codec::ImageFormat::openexr;
  if (const auto foreign = image::sniff_foreign(bytes.view())) return model::codec_format(*foreign);
  if (ending == ".hdr") return codec::ImageFormat::radiance;
  if (ending == ".exr") return codec::ImageFormat::openexr;
  return std::nullopt;
}

float sane(float value) { return std::isfinite(value) ? std::clamp(value, 0.0F, 1e8F) : 0.0F; }

// A channel of a texel: floats are linear light, integers sRGB.
float light_of(const codec::Image& image, std::size_t index) {
  const std::byte* at = image.pixels.data() + index * (image.bits / 8);
  if (image.bits == 32) {
    float value = 0;
    std::memcpy(&value, at, sizeof value);
    return sane(value);
  }
  std::uint16_t value = std::to_integer<std::uint8_t>(*at);
  if (image.bits == 16) std::memcpy(&value, at, sizeof value);
  return render::srgb_decode(static_cast<float>(value) / static_cast<float>(image.full()));
}

// The mean of a square of texels.
Float3 gather(const codec::Image& image, std::uint32_t x, std::uint32_t y, std::uint32_t step) {
  Float3 sum{};
  for (std::uint32_t dy = 0; dy < step; ++dy) {
    for (std::uint32_t dx = 0; dx < step; ++dx) {
      const std::size_t texel = std::size_t{y * step + dy} * image.width + x * step + dx;
      for (std::uint32_t c = 0; c < 3; ++c) {
        const std::uint32_t channel = image.channels < 3 ? 0 : c;
        sum[c] += light_of(image, texel * image.channels + channel);
      }
    }
  }
  const auto count = static_cast<float>(step * step);
  return {sum[0] / count, sum[1] / count, sum[2] / count};
}

render::EnvironmentImage shrunk(const codec::Image& image) {
  const std::uint32_t step =
      std::min((image.width + kWidest - 1) / kWidest, std::min(image.width, image.height));
  render::EnvironmentImage result;
  result.width = image.width / step;
  result.height = image.height / step;
  result.radiance.reserve(std::size_t{result.width} * result.height);
  for (std::uint32_t y = 0; y < result.height; ++y) {
    for (std::uint32_t x = 0; x < result.width; ++x) {
      result.radiance.push_back(gather(image, x, y, step));
    }
  }
  return result;
}

Result<SharedEnvironment> decode(const std::string& path, const container::Bytes& bytes) {
  const std::string name = quoted(path, 200);
  const auto format = format_of(path, bytes);
  if (!format) return Error{fmt::format("the environment {} has no known image format", name)};
  codec::ImageRequest request;
  request.bytes = bytes.view();
  request.format = *format;
  request.pixels = true;
  request.floats = true;
  request.origin = new_origin();
  const auto decoded = codec::Client::shared().decode_image(request);
  if (const auto* error = std::get_if<codec::DecodeError>(&decoded)) {
    return Error{fmt::format("the environment {} cannot be read: {}", name, error->message)};
  }
  return std::make_shared<const render::EnvironmentImage>(
      shrunk(*std::get_if<codec::Image>(&decoded)));
}

/// What was read last. Any number of threads may call: those who want the same wait for it.
class LastEnvironment {
 public:
  Result<SharedEnvironment> read(const std::string& path, const container::Bytes& bytes) {
    HashParts parts;
    parts.add(hash_bytes(bytes.text()));
    parts.add(ending_of(path));
    const Hash128 key = parts.finish();
    const std::lock_guard lock(mutex_);
    if (image_ && key == key_) return image_;
    auto image = decode(path, bytes);
    if (!image) return image;
    key_ = key;
    image_ = *image;
    return image;
  }

  static LastEnvironment& shared() {
    static constinit PerProcess<LastEnvironment> last;
    return last.get();
  }

 private:
  std::mutex mutex_;
  Hash128 key_;
  SharedEnvironment image_;
};

}  // namespace

Result<SharedEnvironment> read_environment(const std::string& path) {
  const auto file = container::open_file(path);
  if (file) return LastEnvironment::shared().read(path, file->bytes);
  return Error{fmt::format("the environment {}: {}", quoted(path, 200), file.error().message)};
}

}  // namespace gltfx
