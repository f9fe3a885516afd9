// SPDX-License-Identifier: Apache-2.0
#include "prove/images.hpp"

#include <cstring>

#include <fmt/format.h>

#include "model/image_codec.hpp"
#include "prove/column.hpp"

namespace gltfx::prove {
namespace {

// Also of formats that glTF does not have. Nothing: of no known format.
std::optional<codec::ImageRequest> request_for(const model::ResourceData& resources,
                                               std::size_t image) {
  const model::ImageData& data = resources.images[image];
  if (model::is_decodable(data)) return model::image_request(resources, image);
  const auto foreign = image::sniff_foreign(data.bytes->view());
  const bool four_inks = data.format == image::Format::jpeg && !data.header;
  if (!four_inks && (data.format || !foreign)) return std::nullopt;
  codec::ImageRequest request;
  request.bytes = data.bytes->view();
  request.format = four_inks ? codec::ImageFormat::jpeg : model::codec_format(*foreign);
  request.origin = resources.origin;
  return request;
}

}  // namespace

Texel Texels::at(std::size_t texel) const {
  const std::size_t first = texel * image_.channels;
  const std::size_t colors = image_.channels < 3 ? 1 : 3;
  Texel result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = number(first + (colors == 1 ? 0 : i));
  const double opaque = has_floats() ? 1 : 255;
  result[3] = image_.has_alpha() ? number(first + colors) : opaque;
  return result;
}

double Texels::number(std::size_t at) const {
  const std::byte* bytes = image_.pixels.data();
  if (image_.bits == 8) return static_cast<double>(bytes[at]);
  if (has_floats()) {
    float value;
    std::memcpy(&value, bytes + at * sizeof(value), sizeof(value));
    return static_cast<double>(value);
  }
  std::uint16_t value;
  std::memcpy(&value, bytes + at * sizeof(value), sizeof(value));
  return value / 257.0;
}

std::variant<codec::Image, std::string> decode_image(const Side& side, std::size_t image) {
  auto wanted = request_for(side.resources(), image);
  if (!wanted) return "unknown format";
  codec::ImageRequest& request = *wanted;
  request.pixels = true;
  codec::ImageResult result = codec::Client::shared().decode_image(request);
  if (auto* error = std::get_if<codec::DecodeError>(&result)) return std::move(error->message);
  return std::get<codec::Image>(std::move(result));
}

std::optional<TexelDifference> compare_texels(const codec::Image& ours,
                                              const codec::Image& theirs) {
  const bool alike = ours.channels == theirs.channels && ours.bits == theirs.bits;
  const bool floats = ours.bits == 32;
  if (alike && !floats && ours.pixels.size() == theirs.pixels.size() &&
      std::memcmp(ours.pixels.data(), theirs.pixels.data(), ours.pixels.size()) == 0) {
    return std::nullopt;
  }
  const Texels here(ours);
  const Texels there(theirs);
  TexelDifference found;
  for (std::size_t i = 0; i < ours.texels(); ++i) {
    const Texel a = here.at(i);
    const Texel b = there.at(i);
    for (std::size_t k = 0; k < 4; ++k) {
      const double steps = apart(a[k], b[k]);
      if (steps <= found.steps) continue;
      found = {static_cast<std::uint32_t>(i % ours.width),
               static_cast<std::uint32_t>(i / ours.width), steps};
    }
  }
  return found.steps > 0 ? std::optional(found) : std::nullopt;
}

std::string distance_text(const TexelDifference& difference, bool floats) {
  return fmt::format("is {:.6g}{} away", difference.steps, floats ? "" : " of 255 steps");
}

void compare_images(const Side& before, const Side& after, const Pair& pair,
                    ImageComparison comparison, Differences& found) {
  const std::string place = before.pointer(pair.ours);
  const std::size_t here = before.index(pair.ours);
  const std::size_t there = after.index(pair.theirs);
  const auto& ours = before.resources().images[here].bytes;
  const auto& theirs = after.resources().images[there].bytes;
  if (!ours) return found.leave_out(place, "has no bytes");
  if (!theirs) return found.add(place, "no longer has bytes");
  if (container::same_bytes(*ours, *theirs)) return;
  if (comparison == ImageComparison::bytes) return found.add(place, "has other bytes");
  const auto left = decode_image(before, here);
  const auto right = decode_image(after, there);
  for (const auto* each : {&left, &right}) {
    if (const auto* why = std::get_if<std::string>(each)) {
      return found.add(place, fmt::format("has other bytes, and {} cannot be decoded ({})",
                                          each == &left ? "it" : "the new image", *why));
    }
  }
  const auto& a = std::get<codec::Image>(left);
  const auto& b = std::get<codec::Image>(right);
  if (a.width != b.width || a.height != b.height) {
    return found.add(place, fmt::format("has {} x {} texels in place of {} x {}", b.width, b.height,
                                        a.width, a.height));
  }
  if ((a.bits == 32) != (b.bits == 32)) return found.add(place, "has another type of texels");
  const auto difference = compare_texels(a, b);
  if (!difference) return;
  found.measure("texel", difference->steps, place);
  found.add(place,
            fmt::format("has a texel {}, {} that {}", difference->x, difference->y,
                        distance_text(*difference, a.bits == 32)),
            difference->steps);
}

}  // namespace gltfx::prove
