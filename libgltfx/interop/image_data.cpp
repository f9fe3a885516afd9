// SPDX-License-Identifier: Apache-2.0
#include "interop/image_data.hpp"

#include <algorithm>
#include <cstring>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <tiny_gltf.h>

#include "base/checked.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "model/image_codec.hpp"
#include "model/memory_budget.hpp"

namespace gltfx::interop {
namespace {

// Limit of the pixels of all images of one asset.
constexpr std::uint64_t kPixelBytes = std::uint64_t{4} << 30U;
// Images that exceed a limit cost seconds each: at most two are tried per asset.
constexpr int kMostCostly = 2;
constexpr std::uint32_t kChannels = 4;

// Any number of channels as RGBA, as loaders of tinygltf give them.
template <class T>
std::vector<unsigned char> as_rgba(const codec::Image& image) {
  std::vector<unsigned char> bytes(static_cast<std::size_t>(image.texels()) * kChannels *
                                   sizeof(T));
  const bool grey = image.channels < 3;
  for (std::size_t i = 0; i < image.texels(); ++i) {
    std::array<T, kChannels> from{};
    std::memcpy(from.data(), image.pixels.data() + i * image.channels * sizeof(T),
                image.channels * sizeof(T));
    const T alpha = image.has_alpha() ? from[image.channels - 1] : static_cast<T>(image.full());
    const std::array<T, kChannels> to{from[0], grey ? from[0] : from[1], grey ? from[0] : from[2],
                                      alpha};
    std::memcpy(bytes.data() + i * sizeof(to), to.data(), sizeof(to));
  }
  return bytes;
}

void set_pixels(const codec::Image& decoded, tinygltf::Image& image) {
  const bool deep = decoded.bits == 16;
  image.image = deep ? as_rgba<std::uint16_t>(decoded) : as_rgba<std::uint8_t>(decoded);
  image.width = static_cast<int>(decoded.width);
  image.height = static_cast<int>(decoded.height);
  image.component = kChannels;
  image.bits = deep ? 16 : 8;
  image.pixel_type =
      deep ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
  image.as_is = false;
}

void set_file(const model::ImageData& data, tinygltf::Image& image) {
  const auto bytes = data.bytes->view();
  const auto* first = reinterpret_cast<const unsigned char*>(bytes.data());
  image.image.assign(first, first + bytes.size());
  image.as_is = true;
  if (!data.header) return;
  image.width = static_cast<int>(data.header->width);
  image.height = static_cast<int>(data.header->height);
}

class Decoding {
 public:
  Decoding(const model::ResourceData& resources, tinygltf::Model& model, Notes& notes)
      : resources_(resources), model_(model), notes_(notes), results_(model.images.size()) {}

  void run(unsigned jobs) {
    model::MemoryBudget budget(kPixelBytes);
    for (std::size_t i = 0; i < results_.size(); ++i) results_[i] = plan(i, budget);
    parallel_ordered(
        results_.size(), jobs, [&](std::size_t i) { decode(i); },
        [&](std::size_t i) { finish(i); });
  }

 private:
  static codec::DecodeError error(std::string why) {
    return {codec::ErrorKind::too_large, std::move(why)};
  }

  // The memory of each image is decided here, in order, so that it does not depend on the number of
  // threads.
  codec::ImageResult plan(std::size_t index, model::MemoryBudget& budget) const {
    const model::ImageData& data = resources_.images[index];
    if (!data.header) return error("has no header that can be read");
    // Such an image would be written as a PNG, which its extension does not allow.
    if (data.header->format == image::Format::ktx2 || data.header->format == image::Format::avif) {
      return error("is not decoded here");
    }
    const Checked texels = checked_mul(data.header->width, data.header->height);
    const std::uint64_t each = kChannels * (data.header->bits > 8 ? 2 : 1);
    if (!texels || !budget.take(checked_mul(*texels, each))) return error("has too many pixels");
    return codec::Image();
  }

  void decode(std::size_t index) {
    if (std::holds_alternative<codec::DecodeError>(results_[index])) return;
    codec::ImageRequest request = model::image_request(resources_, index);
    request.pixels = true;
    results_[index] = codec::Client::shared().decode_image(request);
  }

  void finish(std::size_t index) {
    codec::ImageResult result = std::exchange(results_[index], codec::Image());
    tinygltf::Image& image = model_.images[index];
    if (const auto* error = std::get_if<codec::DecodeError>(&result)) {
      if (codec::is_costly(*error)) stop_after_another();
      set_file(resources_.images[index], image);
      notes_.changed(fmt::format("/images/{}", index),
                     fmt::format("stays encoded: {}", printable(error->message)));
      return;
    }
    set_pixels(std::get<codec::Image>(result), image);
  }

  void stop_after_another() {
    if (++costly_ < kMostCostly) return;
    for (codec::ImageResult& each : results_) each = error("others took too long");
  }

  const model::ResourceData& resources_;
  tinygltf::Model& model_;
  Notes& notes_;
  std::vector<codec::ImageResult> results_;
  int costly_ = 0;
};

bool holds_pixels(const tinygltf::Image& image) {
  if (image.width <= 0 || image.height <= 0 || image.component < 1 || image.component > 4) {
    return false;
  }
  if (image.bits != 8 && image.bits != 16) return false;
  const Checked texels = checked_mul(static_cast<std::uint64_t>(image.width),
                                     static_cast<std::uint64_t>(image.height));
  const auto each = static_cast<std::uint64_t>(image.component * image.bits / 8);
  return texels && checked_mul(*texels, each) == image.image.size();
}

bool is_webp(const tinygltf::Image& image) {
  return image.mimeType == "image/webp" || image.uri.ends_with(".webp");
}

std::string sniffed_type(const tinygltf::Image& image) {
  const auto sniffed = image::sniff(std::as_bytes(std::span(image.image)));
  return sniffed.known ? std::string(image::media_type(sniffed.format)) : image.mimeType;
}

}  // namespace

void place_images(const model::ResourceData& resources, TinygltfImages form, unsigned jobs,
                  tinygltf::Model& model, Notes& notes) {
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    if (i < resources.images.size() && resources.images[i].bytes) continue;
    notes.fail(fmt::format("/images/{} has no bytes", i));
    return;
  }
  if (form == TinygltfImages::decoded) {
    Decoding(resources, model, notes).run(jobs);
    return;
  }
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    set_file(resources.images[i], model.images[i]);
  }
}

std::optional<ImageFile> image_file(const tinygltf::Image& image, const Path& path, Notes& notes) {
  if (image.image.empty()) return std::nullopt;
  const std::string_view held(reinterpret_cast<const char*>(image.image.data()),
                              image.image.size());
  if (image.as_is) return ImageFile{std::string(held), sniffed_type(image)};
  if (!holds_pixels(image)) {
    notes.fail(
        fmt::format("{} has other bytes than its width, height and channels say", path.pointer()));
    return std::nullopt;
  }
  const bool webp = is_webp(image) && image.bits == 8 && image.component >= 3;
  codec::EncodeRequest request;
  request.format = webp ? codec::EncodedFormat::webp : codec::EncodedFormat::png;
  request.quality = 0;
  request.raster = {
      static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height),
      static_cast<std::uint32_t>(image.component), static_cast<std::uint32_t>(image.bits)};
  request.pixels = std::as_bytes(std::span(image.image));
  const auto result = codec::Client::shared().encode_image(request);
  if (const auto* error = std::get_if<codec::DecodeError>(&result)) {
    notes.fail(fmt::format("{} cannot be encoded: {}", path.pointer(), printable(error->message)));
    return std::nullopt;
  }
  const auto& encoded = std::get<codec::EncodedImage>(result);
  return ImageFile{{reinterpret_cast<const char*>(encoded.bytes.data()), encoded.bytes.size()},
                   webp ? "image/webp" : "image/png"};
}

}  // namespace gltfx::interop
