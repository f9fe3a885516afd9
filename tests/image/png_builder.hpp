// SPDX-License-Identifier: Apache-2.0
/// Images made of as little as their headers need.
#pragma once

#include <cstdint>
#include <string>

#include "codec/support/png_encoder.hpp"
#include "image/ktx2_builder.hpp"

namespace gltfx::test {

inline std::string be32(std::uint32_t value) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xFFU);
  return text;
}

inline std::string png_chunk(const std::string& type, const std::string& content) {
  return png_encoder::chunk(type, content);
}

struct PngHeader {
  std::uint32_t width = 4;
  std::uint32_t height = 2;
  char depth = 8;
  char color_type = 2;
  char interlace = 0;
  char compression = 0;
  char filter = 0;
};

/// A PNG of sound chunks, whose image data end after their first bytes.
inline std::string png(const std::string& chunks = {}, const PngHeader& header = {}) {
  const std::string ihdr = be32(header.width) + be32(header.height) + header.depth +
                           header.color_type + header.compression + header.filter +
                           header.interlace;
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", ihdr) + chunks + png_chunk("IDAT", "\x78\x9c") +
         png_chunk("IEND", "");
}

inline std::string jpeg_segment(unsigned char marker, const std::string& content) {
  const auto length = static_cast<std::uint16_t>(content.size() + 2);
  return std::string{'\xff', static_cast<char>(marker), static_cast<char>(length >> 8U),
                     static_cast<char>(length & 0xFFU)} +
         content;
}

/// A frame header of 8 bits, 32 x 16 pixels, components 1, 2 and so on without subsampling.
inline std::string jpeg_frame(char components, unsigned char marker = 0xC0) {
  std::string content{8, 0, 16, 0, 32, components};
  for (char id = 1; id <= components; ++id) content += std::string{id, 0x11, 0};
  return jpeg_segment(marker, content);
}

/// Quantisation table 0, and Huffman tables 0 of one symbol each.
inline std::string jpeg_tables() {
  const std::string code = '\1' + std::string(16, '\0');
  return jpeg_segment(0xDB, '\0' + std::string(64, '\1')) +
         jpeg_segment(0xC4, '\0' + code + '\x10' + code);
}

/// The header of a scan of all components, and no data.
inline std::string jpeg_scan(char components, const std::string& band = {0, 63, 0}) {
  std::string content{components};
  for (char id = 1; id <= components; ++id) content += std::string{id, 0};
  return jpeg_segment(0xDA, content + band);
}

inline std::string jpeg(const std::string& segments) {
  return "\xff\xd8" + jpeg_segment(0xE0, "JFIF padding") + segments;
}

/// A JPEG with everything before its image data, after other segments.
inline std::string whole_jpeg(const std::string& segments = {}, char components = 3) {
  return jpeg(segments + jpeg_frame(components) + jpeg_tables() + jpeg_scan(components));
}

/// A chunk of a WebP, padded.
inline std::string webp_chunk(const std::string& type, const std::string& content) {
  return type + le(content.size(), 4) + content + std::string(content.size() % 2, '\0');
}

inline std::string webp_file(const std::string& chunks) {
  return "RIFF" + le(chunks.size() + 4, 4) + "WEBP" + chunks;
}

inline std::string webp(const std::string& type, const std::string& content) {
  return webp_file(webp_chunk(type, content));
}

/// The content of a lossless image, as far as its header.
inline std::string webp_lossless(std::uint32_t width, std::uint32_t height, bool alpha = false) {
  return '\x2f' + le((width - 1) | (height - 1) << 14U | (alpha ? 1U : 0U) << 28U, 4);
}

/// A WebP of 4 by 4 pixels in the extended form, with an image that matches its flags.
inline std::string extended_webp(char flags) {
  return webp_file(webp_chunk("VP8X", flags + le(0, 3) + le(3, 3) + le(3, 3)) +
                   webp_chunk("VP8L", webp_lossless(4, 4, (flags & 0x10) != 0)));
}

}  // namespace gltfx::test
