// SPDX-License-Identifier: Apache-2.0
/// Images in formats that are not part of glTF, according to their specifications: eight texels
/// each.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace gltfx::test {

inline constexpr unsigned kForeignWidth = 4;
inline constexpr unsigned kForeignHeight = 2;
/// Red, green, blue and alpha, in rows from the top.
inline constexpr std::array<std::array<std::uint8_t, 4>, 8> kForeignTexels{{{200, 100, 50, 128},
                                                                            {1, 2, 3, 4},
                                                                            {255, 255, 255, 255},
                                                                            {9, 8, 7, 64},
                                                                            {0, 0, 0, 0},
                                                                            {10, 20, 30, 40},
                                                                            {77, 66, 55, 44},
                                                                            {5, 250, 5, 250}}};

/// Appends numbers to a text.
class FileBytes {
 public:
  explicit FileBytes(bool big_endian = false) : big_endian_(big_endian) {}
  FileBytes& text(std::string_view text) {
    bytes_ += text;
    return *this;
  }
  FileBytes& u8(unsigned value) { return number(value, 1); }
  FileBytes& u16(unsigned value) { return number(value, 2); }
  FileBytes& u32(std::uint32_t value) { return number(value, 4); }
  std::string take() const { return bytes_; }

 private:
  FileBytes& number(std::uint32_t value, unsigned size) {
    for (unsigned i = 0; i < size; ++i) {
      bytes_ += static_cast<char>(value >> 8 * (big_endian_ ? size - 1 - i : i));
    }
    return *this;
  }
  bool big_endian_;
  std::string bytes_;
};

/// 32 bits per texel without masks: the fourth byte, here 0, has no meaning.
inline std::string unused_byte_bmp_file() {
  FileBytes file;
  file.text("BM").u32(54 + 32).u32(0).u32(54);
  file.u32(40).u32(kForeignWidth).u32(kForeignHeight).u16(1).u16(32).u32(0).u32(32);
  file.u32(2835).u32(2835).u32(0).u32(0);
  for (const unsigned i : {4U, 5U, 6U, 7U, 0U, 1U, 2U, 3U}) {
    for (const unsigned c : {2U, 1U, 0U}) file.u8(kForeignTexels[i][c]);
    file.u8(0);
  }
  return file.take();
}

inline std::string bmp_file(std::uint32_t width = kForeignWidth) {
  FileBytes file;
  file.text("BM").u32(54 + 24).u32(0).u32(54);
  file.u32(40).u32(width).u32(kForeignHeight).u16(1).u16(24).u32(0).u32(24);
  file.u32(2835).u32(2835).u32(0).u32(0);
  for (const unsigned i : {4U, 5U, 6U, 7U, 0U, 1U, 2U, 3U}) {
    for (const unsigned c : {2U, 1U, 0U}) file.u8(kForeignTexels[i][c]);
  }
  return file.take();
}

/// With alpha, and with or without the footer of version 2.
inline std::string tga_file(bool footer = true) {
  FileBytes file;
  file.u8(0).u8(0).u8(2).u16(0).u16(0).u8(0).u16(0).u16(0);
  file.u16(kForeignWidth).u16(kForeignHeight).u8(32).u8(0x28);
  for (const auto& texel : kForeignTexels) {
    for (const unsigned c : {2U, 1U, 0U, 3U}) file.u8(texel[c]);
  }
  if (footer) file.u32(0).u32(0).text({"TRUEVISION-XFILE.\0", 18});
  return file.take();
}

/// The red of the texels as grey, with alpha.
inline std::string grey_alpha_tga_file() {
  FileBytes file;
  file.u8(0).u8(0).u8(3).u16(0).u16(0).u8(0).u16(0).u16(0);
  file.u16(kForeignWidth).u16(kForeignHeight).u8(16).u8(0x28);
  for (const auto& texel : kForeignTexels) file.u8(texel[0]).u8(texel[3]);
  return file.take();
}

/// Five bits per color and one of alpha.
inline std::string one_bit_alpha_tga_file() {
  FileBytes file;
  file.u8(0).u8(0).u8(2).u16(0).u16(0).u8(0).u16(0).u16(0);
  file.u16(kForeignWidth).u16(kForeignHeight).u8(16).u8(0x21);
  for (unsigned i = 0; i < 8; ++i) file.u16(i << 15U | i << 5U);
  return file.take();
}

/// A palette of two colors with alpha.
inline std::string alpha_palette_tga_file() {
  FileBytes file;
  file.u8(0).u8(1).u8(1).u16(0).u16(2).u8(32).u16(0).u16(0);
  file.u16(kForeignWidth).u16(kForeignHeight).u8(8).u8(0x20);
  for (const unsigned i : {0U, 1U}) {
    for (const unsigned c : {2U, 1U, 0U, 3U}) file.u8(kForeignTexels[i][c]);
  }
  for (unsigned i = 0; i < 8; ++i) file.u8(i & 1U);
  return file.take();
}

/// Bilevel, with the default of one bit per sample.
inline std::string default_bits_tiff_file() {
  FileBytes file;
  file.text({"II*\0", 4}).u32(8).u16(7);
  const auto entry = [&](unsigned tag, unsigned type, std::uint32_t value) {
    file.u16(tag).u16(type).u32(1).u32(value);
  };
  entry(256, 3, kForeignWidth);
  entry(257, 3, kForeignHeight);
  entry(259, 3, 1);
  entry(262, 3, 1);
  entry(273, 4, 8 + 2 + 7 * 12 + 4);
  entry(278, 3, kForeignHeight);
  entry(279, 4, 2);
  return file.u32(0).u8(0x50).u8(0xA0).take();
}

/// With the area of version 2 that says that colours are multiplied by alpha.
inline std::string multiplied_tga_file() {
  constexpr unsigned kAreaSize = 495;
  const std::string plain = tga_file(false);
  FileBytes file;
  file.text(plain).u16(kAreaSize);
  for (unsigned i = 2; i + 1 < kAreaSize; ++i) file.u8(0);
  file.u8(4);
  file.u32(static_cast<std::uint32_t>(plain.size())).u32(0).text({"TRUEVISION-XFILE.\0", 18});
  return file.take();
}

/// Two frames, of which the second one has colours in another order. The first color may be
/// transparent, and a frame may cover the first row alone.
inline std::string gif_file(bool transparent = false, unsigned frame_height = kForeignHeight) {
  FileBytes file;
  file.text("GIF89a").u16(kForeignWidth).u16(kForeignHeight).u8(0xF2).u8(0).u8(0);
  for (const auto& texel : kForeignTexels) file.u8(texel[0]).u8(texel[1]).u8(texel[2]);
  for (unsigned frame = 0; frame < 2; ++frame) {
    if (transparent) file.u8(0x21).u8(0xF9).u8(4).u8(1).u16(0).u8(0).u8(0);
    file.text(",").u16(0).u16(0).u16(kForeignWidth).u16(frame_height).u8(0).u8(3);
    // Codes of four bits; code 8 clears the table before it needs five.
    std::vector<unsigned> codes{8};
    for (unsigned i = 0; i < kForeignWidth * frame_height; ++i) {
      if (i == 5) codes.push_back(8);
      codes.push_back(frame == 0 ? i : 7 - i);
    }
    codes.push_back(9);
    codes.resize((codes.size() + 1) / 2 * 2);
    file.u8(static_cast<unsigned>(codes.size() / 2));
    for (std::size_t i = 0; i < codes.size(); i += 2) file.u8(codes[i] | codes[i + 1] << 4U);
    file.u8(0);
  }
  file.text(";");
  return file.take();
}

enum class TiffAlpha : std::uint8_t { none, associated, unassociated };

/// One strip of 8 bits, or of floats that are half of the texels. Grey is the red of the texels.
inline std::string tiff_file(TiffAlpha alpha, bool floats = false, bool grey = false) {
  const unsigned colors = grey ? 1 : 3;
  const unsigned channels = colors + (alpha == TiffAlpha::none ? 0 : 1);
  const unsigned size = floats ? 4 : 1;
  const unsigned entries = alpha == TiffAlpha::none ? 10 : 11;
  const std::uint32_t behind = 8 + 2 + (entries + 1) * 12 + 4;
  FileBytes file;
  file.text({"II*\0", 4}).u32(8).u16(entries + 1);
  const auto entry = [&](unsigned tag, unsigned type, std::uint32_t count, std::uint32_t value) {
    file.u16(tag).u16(type).u32(count).u32(value);
  };
  entry(256, 3, 1, kForeignWidth);
  entry(257, 3, 1, kForeignHeight);
  // One number or two are in the entry.
  const auto of_channels = [&](unsigned tag, std::uint32_t value, std::uint32_t at) {
    entry(tag, 3, channels, channels > 2 ? at : channels == 2 ? value << 16U | value : value);
  };
  of_channels(258, size * 8, behind);
  entry(259, 3, 1, 1);
  entry(262, 3, 1, grey ? 1 : 2);
  entry(273, 4, 1, behind + 16);
  entry(277, 3, 1, channels);
  entry(278, 3, 1, kForeignHeight);
  entry(279, 4, 1, 8 * channels * size);
  entry(284, 3, 1, 1);
  if (alpha != TiffAlpha::none) entry(338, 3, 1, alpha == TiffAlpha::associated ? 1 : 2);
  of_channels(339, floats ? 3 : 1, behind + 8);
  file.u32(0);
  for (unsigned c = 0; c < 4; ++c) file.u16(size * 8);
  for (unsigned c = 0; c < 4; ++c) file.u16(floats ? 3 : 1);
  for (const auto& texel : kForeignTexels) {
    for (unsigned c = 0; c < channels; ++c) {
      unsigned value = texel[c < colors ? c : 3];
      if (alpha == TiffAlpha::associated && c < colors) value = (value * texel[3] + 127) / 255;
      if (!floats) {
        file.u8(value);
        continue;
      }
      const float half = static_cast<float>(value) / 2;
      std::uint32_t bits = 0;
      std::memcpy(&bits, &half, sizeof bits);
      file.u32(bits);
    }
  }
  return file.take();
}

/// Without layers: the merged image.
inline std::string psd_file() {
  FileBytes file(true);
  file.text("8BPS").u16(1).u16(0).u32(0).u16(3).u32(kForeignHeight).u32(kForeignWidth);
  file.u16(8).u16(3).u32(0).u32(0).u32(0).u16(0);
  for (unsigned c = 0; c < 3; ++c) {
    for (const auto& texel : kForeignTexels) file.u8(texel[c]);
  }
  return file.take();
}

/// Plain texels with alpha.
inline std::string dds_file() {
  FileBytes file;
  file.text("DDS ").u32(124).u32(0x100F).u32(kForeignHeight).u32(kForeignWidth).u32(16).u32(0);
  for (unsigned i = 0; i < 12; ++i) file.u32(0);
  file.u32(32).u32(0x41).u32(0).u32(32);
  file.u32(0xFF).u32(0xFF00).u32(0xFF0000).u32(0xFF000000);
  file.u32(0x1000).u32(0).u32(0).u32(0).u32(0);
  for (const auto& texel : kForeignTexels) {
    for (const unsigned value : texel) file.u8(value);
  }
  return file.take();
}

/// One block of 4 by 4 equal texels, (66, 0, 0, 128), of DXT4 or DXT5.
inline std::string dxt_file(const char* format) {
  FileBytes file;
  file.text("DDS ").u32(124).u32(0x81007).u32(4).u32(4).u32(16).u32(0);
  for (unsigned i = 0; i < 12; ++i) file.u32(0);
  file.u32(32).u32(4).text(format).u32(0).u32(0).u32(0).u32(0).u32(0);
  file.u32(0x1000).u32(0).u32(0).u32(0).u32(0);
  file.u8(128).u8(128).u16(0).u32(0);
  file.u16(8U << 11U).u16(8U << 11U).u32(0);
  return file.take();
}

inline std::string ppm_file() {
  FileBytes file;
  file.text("P6\n4 2\n255\n");
  for (const auto& texel : kForeignTexels) file.u8(texel[0]).u8(texel[1]).u8(texel[2]);
  return file.take();
}

}  // namespace gltfx::test
