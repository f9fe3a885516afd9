// SPDX-License-Identifier: Apache-2.0
#include "steps/upgrade/render.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>

#include <fmt/format.h>

#include "base/text.hpp"

namespace gltfx::upgrade {
namespace {

constexpr std::size_t kAlpha = 3;

bool is_opaque(const ChannelSource& alpha) { return !alpha.image && alpha.offset >= 1; }

/// One channel of a new image, computed once for each possible number of the source.
template <typename T>
class Channel {
 public:
  Channel(const ChannelSource& source, const codec::Image* image, std::uint32_t full) {
    const double plus = std::round(source.offset * full);
    if (image == nullptr || place_of(*image, source.channel) < 0) {
      const double alone = image == nullptr ? plus : plus + std::round(source.scale * full);
      table_.push_back(cut(alone, full));
      return;
    }
    pixels_ = image->pixels.data();
    place_ = static_cast<std::size_t>(place_of(*image, source.channel));
    step_ = image->channels;
    wide_ = image->bits == 16;
    const double widen = static_cast<double>(full) / image->full();
    table_.reserve(image->full() + std::size_t{1});
    for (std::uint32_t value = 0; value <= image->full(); ++value) {
      table_.push_back(cut(plus + std::round(source.scale * value * widen), full));
    }
  }

  // Writes the values of all texels, from `to` at intervals of `step`.
  void write(T* to, std::size_t step, std::size_t texels) const {
    if (pixels_ == nullptr) {
      for (std::size_t i = 0; i < texels; ++i) to[i * step] = table_[0];
    } else if (wide_) {
      copy(reinterpret_cast<const std::uint16_t*>(pixels_), to, step, texels);
    } else {
      copy(reinterpret_cast<const std::uint8_t*>(pixels_), to, step, texels);
    }
  }

 private:
  static T cut(double value, std::uint32_t full) {
    return static_cast<T>(std::clamp(value, 0.0, static_cast<double>(full)));
  }

  template <typename From>
  void copy(const From* from, T* to, std::size_t step, std::size_t texels) const {
    from += place_;
    for (std::size_t i = 0; i < texels; ++i) to[i * step] = table_[from[i * step_]];
  }

  std::vector<T> table_;
  const std::byte* pixels_ = nullptr;
  std::size_t place_ = 0, step_ = 0;
  bool wide_ = false;
};

template <typename T>
void fill(Texels& texels, const Recipe& recipe) {
  const std::uint32_t full = texels.raster.bits == 16 ? 65535 : 255;
  const std::size_t step = texels.raster.channels;
  const std::size_t count = std::size_t{texels.raster.width} * texels.raster.height;
  texels.bytes.resize(count * step * sizeof(T));
  if (count == 0) return;
  auto* to = reinterpret_cast<T*>(texels.bytes.data());
  for (std::size_t i = 0; i < step; ++i) {
    Channel<T>(recipe.job.channels[i], recipe.images[i].get(), full).write(to + i, step, count);
  }
}

Result<Recipe> recipe_of(const ImageJob& job, Pictures& pictures) {
  Recipe recipe;
  recipe.job = job;
  const codec::Image* first = nullptr;
  for (std::size_t i = 0; i < job.channels.size(); ++i) {
    if (!job.channels[i].image) continue;
    const std::uint64_t index = *job.channels[i].image;
    recipe.job.channels[i].image = 0;
    recipe.images[i] = pictures.pixels(index);
    const codec::Image* image = recipe.images[i].get();
    if (image == nullptr) {
      return Error{fmt::format("image {}: {}", index, pictures.picture(index).problem)};
    }
    if (first == nullptr) first = image;
    if (image->width != first->width || image->height != first->height) {
      return Error{fmt::format("image {} has a different size than the other one", index)};
    }
  }
  if (first == nullptr) return Error{"a new image has no source"};
  return recipe;
}

}  // namespace

Texels mix(const Recipe& recipe) {
  Texels texels;
  codec::Raster& raster = texels.raster;
  raster.bits = 8;
  for (const auto& image : recipe.images) {
    if (!image) continue;
    raster.width = image->width;
    raster.height = image->height;
    raster.bits = std::max(raster.bits, image->bits);
  }
  raster.channels = is_opaque(recipe.job.channels[kAlpha]) ? 3 : 4;
  if (raster.bits == 16) {
    fill<std::uint16_t>(texels, recipe);
  } else {
    fill<std::uint8_t>(texels, recipe);
  }
  return texels;
}

Result<std::shared_ptr<const std::string>> render(const ImageJob& job, Pictures& pictures,
                                                  ImageCache& cache, const Origin& origin) {
  const Result<Recipe> recipe = recipe_of(job, pictures);
  if (!recipe) return recipe.error();
  if (auto known = cache.find(*recipe)) return known;
  const Texels texels = mix(*recipe);
  codec::EncodeRequest request;
  request.raster = texels.raster;
  request.pixels = texels.bytes;
  request.origin = origin;
  const codec::EncodeResult result = codec::Client::shared().encode_image(request);
  if (const auto* error = std::get_if<codec::DecodeError>(&result)) {
    return Error{fmt::format("the new image cannot be encoded: {}", printable(error->message))};
  }
  const auto& bytes = std::get_if<codec::EncodedImage>(&result)->bytes;
  auto file = std::make_shared<const std::string>(reinterpret_cast<const char*>(bytes.data()),
                                                  bytes.size());
  cache.keep(*recipe, file);
  return file;
}

}  // namespace gltfx::upgrade
