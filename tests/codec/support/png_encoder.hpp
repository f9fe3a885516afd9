// SPDX-License-Identifier: Apache-2.0
/// Makes valid PNG images for tests, without compression.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

namespace gltfx::test {

namespace png_encoder {

inline std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

inline std::string big_endian(std::uint32_t value) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xFFU);
  return text;
}

inline std::string chunk(const std::string& type, const std::string& content) {
  return big_endian(static_cast<std::uint32_t>(content.size())) + type + content +
         big_endian(crc32(type + content));
}

inline std::string zlib_stored(const std::string& bytes) {
  std::string text = "\x78\x01";
  std::uint32_t a = 1, b = 0;
  for (const char byte : bytes) {
    a = (a + static_cast<unsigned char>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  for (std::size_t at = 0; at < bytes.size() || at == 0; at += 65535) {
    const std::size_t size = std::min<std::size_t>(65535, bytes.size() - at);
    text += at + size == bytes.size() ? '\1' : '\0';
    for (const std::size_t value : {size, ~size}) {
      text += static_cast<char>(value & 0xFFU);
      text += static_cast<char>(value >> 8U & 0xFFU);
    }
    text += bytes.substr(at, size);
  }
  return text + big_endian(b << 16U | a);
}

}  // namespace png_encoder

/// Colour types of PNG.
enum class PngColor : char { grey = 0, rgb = 2, palette = 3, grey_alpha = 4, rgba = 6 };

struct PngImage {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  PngColor color = PngColor::rgb;
  char bits = 8;
  std::string texels;       ///< packed rows; 16 bits in big-endian order
  std::string chunks{};     ///< between header and data; see png_encoder::chunk()
  bool interlaced = false;  ///< only in the header; the rows are not interlaced
};

inline std::string encode_png(const PngImage& image) {
  using namespace png_encoder;
  const std::size_t row = image.texels.size() / image.height;
  std::string rows;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    rows += '\0';  // no filter
    rows += image.texels.substr(y * row, row);
  }
  const std::string header = big_endian(image.width) + big_endian(image.height) + image.bits +
                             static_cast<char>(image.color) + std::string(2, '\0') +
                             (image.interlaced ? '\1' : '\0');
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + image.chunks +
         chunk("IDAT", zlib_stored(rows)) + chunk("IEND", "");
}

}  // namespace gltfx::test
