// SPDX-License-Identifier: Apache-2.0
/// Images made of as little as their headers need.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>

namespace gltfx::test {

inline std::string be32(std::uint32_t value) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xFFU);
  return text;
}

/// A chunk whose checksum is wrong: nobody looks at it.
inline std::string png_chunk(const std::string& type, const std::string& content) {
  return be32(static_cast<std::uint32_t>(content.size())) + type + content + "CRC!";
}

struct PngHeader {
  std::uint32_t width = 4;
  std::uint32_t height = 2;
  char depth = 8;
  char color_type = 2;
  char interlace = 0;
};

inline std::string png(const std::string& chunks = {}, const PngHeader& header = {}) {
  const std::string ihdr = be32(header.width) + be32(header.height) + header.depth +
                           header.color_type + std::string(2, '\0') + header.interlace;
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", ihdr) + chunks + png_chunk("IDAT", "x");
}

inline std::string jpeg_segment(unsigned char marker, const std::string& content) {
  const auto length = static_cast<std::uint16_t>(content.size() + 2);
  return std::string{'\xff', static_cast<char>(marker), static_cast<char>(length >> 8U),
                     static_cast<char>(length & 0xFFU)} +
         content;
}

/// A frame header of 8 bits, 32 x 16 pixels.
inline std::string jpeg_frame(char components, unsigned char marker = 0xC0) {
  return jpeg_segment(marker, std::string{8, 0, 16, 0, 32, components} +
                                  std::string(static_cast<std::size_t>(components) * 3, '\1'));
}

inline std::string jpeg(const std::string& segments) {
  return "\xff\xd8" + jpeg_segment(0xE0, "JFIF padding") + segments;
}

inline std::string webp(const std::string& type, const std::string& content) {
  return "RIFF----WEBP" + type + "----" + content;
}

}  // namespace gltfx::test
