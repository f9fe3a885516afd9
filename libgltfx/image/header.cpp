// SPDX-License-Identifier: Apache-2.0
#include "image/header.hpp"

#include <array>

#include "image/cursor.hpp"

namespace gltfx::image {

std::string_view media_type(Format format) {
  constexpr std::array<std::string_view, 5> kTypes{"image/png", "image/jpeg", "image/webp",
                                                   "image/avif", "image/ktx2"};
  return kTypes[static_cast<std::size_t>(format)];
}

std::string_view channels_name(Channels channels) {
  constexpr std::array<std::string_view, 6> kNames{"luminance", "luminance-alpha", "rgb", "rgba",
                                                   "red",       "red-green"};
  return kNames[static_cast<std::size_t>(channels)];
}

std::string_view tag_name(Tag tag) {
  constexpr std::array<std::string_view, 4> kNames{"", "srgb", "linear", "custom"};
  return kNames[static_cast<std::size_t>(tag)];
}

Sniffed sniff(std::span<const std::byte> bytes) {
  using namespace std::literals;
  Cursor at(bytes);
  if (bytes.size() < kSniffBytes) return {};
  if (at.at("\x89PNG\r\n\x1a\n"sv)) return {true, Format::png};
  if (at.at("\xff\xd8\xff"sv)) return {true, Format::jpeg};
  if (at.at("\xabKTX 20\xbb\r\n\x1a\n"sv)) return {true, Format::ktx2};
  if (is_avif(bytes)) return {true, Format::avif};
  if (at.at("RIFF"sv)) {
    at.skip(8);
    if (at.at("WEBPVP"sv)) return {true, Format::webp};
  }
  return {};
}

HeaderResult read_header(std::span<const std::byte> bytes) {
  const Sniffed found = sniff(bytes);
  if (!found.known) return HeaderError{};
  switch (found.format) {
    case Format::png:
      return read_png(bytes);
    case Format::jpeg:
      return read_jpeg(bytes);
    case Format::webp:
      return read_webp(bytes);
    case Format::avif:
      return read_avif(bytes);
    case Format::ktx2:
      break;
  }
  return HeaderError{};
}

}  // namespace gltfx::image
