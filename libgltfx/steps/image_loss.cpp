// SPDX-License-Identifier: Apache-2.0
#include "steps/image_loss.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>
#include <variant>

namespace gltfx::steps {
namespace {

constexpr double kGreatest = 255;

class TexelReader {
 public:
  explicit TexelReader(const codec::Image& image) : image_(image) {}

  std::array<double, 4> at(std::uint64_t texel) const {
    const std::uint64_t first = texel * image_.channels;
    std::array<double, 4> values{};
    for (std::uint32_t c = 0; c < 3; ++c) {
      values[c] = number(first + (image_.channels < 3 ? 0 : c));
    }
    values[3] = image_.has_alpha() ? number(first + image_.channels - 1) : kGreatest;
    return values;
  }

 private:
  double number(std::uint64_t at) const {
    if (image_.bits == 8) return static_cast<double>(image_.pixels[at]);
    constexpr double kStep = 257;
    std::uint16_t value = 0;
    std::memcpy(&value, image_.pixels.data() + at * sizeof value, sizeof value);
    return value / kStep;
  }

  const codec::Image& image_;
};

codec::ImageFormat format_of(codec::EncodedFormat format) {
  if (format == codec::EncodedFormat::jpeg) return codec::ImageFormat::jpeg;
  return format == codec::EncodedFormat::webp ? codec::ImageFormat::webp : codec::ImageFormat::png;
}

std::optional<codec::Image> pixels_of(codec::ImageRequest request) {
  request.pixels = true;
  codec::ImageResult result = codec::Client::shared().decode_image(request);
  if (auto* image = std::get_if<codec::Image>(&result)) return std::move(*image);
  return std::nullopt;
}

}  // namespace

double ImageDistance::decibels() const {
  if (mean_square == 0) return std::numeric_limits<double>::infinity();
  return 10 * std::log10(kGreatest * kGreatest / mean_square);
}

std::optional<ImageDistance> distance(const codec::Image& one, const codec::Image& other) {
  if (one.width != other.width || one.height != other.height) return std::nullopt;
  if (one.bits > 16 || other.bits > 16 || one.texels() == 0) return std::nullopt;
  const TexelReader ours(one);
  const TexelReader theirs(other);
  const std::size_t channels = one.has_alpha() || other.has_alpha() ? 4 : 3;
  ImageDistance found;
  for (std::uint64_t i = 0; i < one.texels(); ++i) {
    const std::array<double, 4> a = ours.at(i);
    const std::array<double, 4> b = theirs.at(i);
    for (std::size_t c = 0; c < channels; ++c) {
      const double off = std::abs(a[c] - b[c]);
      found.greatest = std::max(found.greatest, off);
      found.mean_square += off * off;
    }
  }
  found.mean_square /= static_cast<double>(one.texels() * channels);
  return found;
}

std::optional<ImageDistance> distance(const codec::TranscodeRequest& request,
                                      const codec::EncodedImage& file) {
  const auto before = pixels_of(request.image);
  codec::ImageRequest again;
  again.bytes = file.bytes;
  again.format = format_of(request.format);
  again.max_pixels = std::uint64_t{file.raster.width} * file.raster.height;
  again.origin = request.image.origin;
  const auto after = pixels_of(again);
  return before && after ? distance(*before, *after) : std::nullopt;
}

}  // namespace gltfx::steps
