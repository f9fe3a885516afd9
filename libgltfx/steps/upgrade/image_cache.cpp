// SPDX-License-Identifier: Apache-2.0
#include "steps/upgrade/image_cache.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/fork.hpp"
#include "base/hash.hpp"
#include "base/text.hpp"
#include "image/header.hpp"
#include "image/ktx2.hpp"
#include "model/image_codec.hpp"

namespace gltfx::upgrade {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{256} << 20U;  // for each kind

template <typename T>
bool is_alpha_red(const codec::Image& image) {
  const auto* texels = reinterpret_cast<const T*>(image.pixels.data());
  const std::size_t step = image.channels;
  const std::size_t count = static_cast<std::size_t>(image.texels()) * step;
  for (std::size_t at = 0; at < count; at += step) {
    if (texels[at] != texels[at + step - 1]) return false;
  }
  return true;
}

bool is_alpha_red(const codec::Image& image) {
  if (!image.has_alpha()) return false;
  return image.bits == 16 ? is_alpha_red<std::uint16_t>(image) : is_alpha_red<std::uint8_t>(image);
}

Decoded unreadable(std::string why) {
  Decoded none;
  none.picture.problem = std::move(why);
  return none;
}

std::optional<image::Header> header_of(std::span<const std::byte> bytes) {
  const image::HeaderResult header = image::read_header(bytes);
  if (const auto* found = std::get_if<image::Header>(&header)) return *found;
  return std::nullopt;
}

Decoded decode_as(codec::ImageFormat format, const std::optional<image::Header>& header,
                  const container::Bytes& bytes, const Origin& origin) {
  codec::ImageRequest request;
  request.bytes = bytes.view();
  request.format = format;
  request.pixels = true;
  request.origin = origin;
  if (header) request.max_pixels = std::min(request.max_pixels, image::texels_of(*header));
  codec::ImageResult result = codec::Client::shared().decode_image(request);
  if (const auto* error = std::get_if<codec::DecodeError>(&result)) {
    Decoded none = unreadable(fmt::format("it cannot be decoded: {}", printable(error->message)));
    none.may_pass =
        error->kind != codec::ErrorKind::malformed && error->kind != codec::ErrorKind::too_large;
    return none;
  }
  auto image = std::make_shared<codec::Image>(std::move(*std::get_if<codec::Image>(&result)));
  if (!image->doubt.empty()) {
    return unreadable(fmt::format("it is corrupt: {}", printable(image->doubt)));
  }
  Decoded decoded;
  decoded.picture.image = *image;
  decoded.picture.image.pixels = {};
  decoded.picture.image.owner.reset();
  decoded.picture.alpha_is_red = is_alpha_red(*image);
  decoded.pixels = std::move(image);
  return decoded;
}

Decoded decode_any(const container::Bytes& bytes, const Origin& origin) {
  const image::Sniffed sniffed = image::sniff(bytes.view());
  if (!sniffed.known) return unreadable("its format is unknown");
  const codec::ImageFormat format = model::codec_format(sniffed.format);
  if (sniffed.format != image::Format::ktx2) {
    return decode_as(format, header_of(bytes.view()), bytes, origin);
  }
  const image::Ktx2 file = image::read_ktx2(bytes.view());
  if (image::has_known_texels(file)) {
    return decode_as(format, image::header_of(file), bytes, origin);
  }
  return unreadable(
      fmt::format("it is {}, whose pixels cannot be read", image::media_type(sniffed.format)));
}

std::uint64_t weight(const container::Bytes& bytes, const Decoded& decoded) {
  return bytes.size() + (decoded.pixels ? decoded.pixels->pixels.size() : 0);
}

// A recipe keeps the pixels of its sources.
std::uint64_t weight(const Recipe& recipe, const std::string& file) {
  std::uint64_t bytes = file.size();
  for (const auto& image : recipe.images) bytes += image ? image->pixels.size() : 0;
  return bytes;
}

}  // namespace

std::shared_ptr<const Decoded> ImageCache::known(const Origin& origin, std::uint64_t hash,
                                                 std::string_view bytes) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(images_.begin(), images_.end(), [&](const Image& image) {
    return image.origin == origin && image.hash == hash && image.bytes.text() == bytes;
  });
  if (found == images_.end()) return nullptr;
  std::rotate(found, found + 1, images_.end());
  return images_.back().decoded;
}

std::shared_ptr<const Decoded> ImageCache::decode(const container::Bytes& bytes,
                                                  const Origin& origin) {
  const std::uint64_t hash = content_hash(bytes.text());
  if (auto decoded = known(origin, hash, bytes.text())) return decoded;
  auto decoded = std::make_shared<const Decoded>(decode_any(bytes, origin));
  if (!decoded->pixels) return decoded;  // decoding again may succeed
  const std::lock_guard lock(mutex_);
  image_bytes_ += weight(bytes, *decoded);
  images_.push_back({origin, hash, bytes, decoded});
  while (image_bytes_ > kMostBytes) {
    image_bytes_ -= weight(images_.front().bytes, *images_.front().decoded);
    images_.pop_front();
  }
  return decoded;
}

std::shared_ptr<const std::string> ImageCache::find(const Recipe& recipe) {
  const std::lock_guard lock(mutex_);
  for (const File& file : files_) {
    if (file.recipe == recipe) return file.bytes;
  }
  return nullptr;
}

void ImageCache::keep(const Recipe& recipe, std::shared_ptr<const std::string> file) {
  const std::lock_guard lock(mutex_);
  file_bytes_ += weight(recipe, *file);
  files_.push_back({recipe, std::move(file)});
  while (file_bytes_ > kMostBytes) {
    file_bytes_ -= weight(files_.front().recipe, *files_.front().bytes);
    files_.pop_front();
  }
}

ImageCache& ImageCache::shared() {
  static constinit PerProcess<ImageCache> cache;
  return cache.get();
}

}  // namespace gltfx::upgrade
