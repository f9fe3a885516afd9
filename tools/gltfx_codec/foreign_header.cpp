// SPDX-License-Identifier: Apache-2.0
#include "foreign_header.hpp"

#include <cstdint>

#include "image/cursor.hpp"

namespace gltfx::codec {
namespace {

using image::Cursor;

// Skips the rest of a GIF's extension, which consists of blocks that begin with their size.
void skip_blocks(Cursor& cursor) {
  while (const std::uint8_t size = cursor.u8()) cursor.skip(size);
}

// The size of a GIF's table of colors.
std::uint32_t table_size(std::uint8_t flags) {
  return (flags & 0x80U) != 0 ? 3U << ((flags & 7U) + 1) : 0;
}

}  // namespace

bool has_unused_byte(std::span<const std::byte> bmp) {
  Cursor cursor(bmp);
  cursor.skip(28);
  const std::uint16_t bits = cursor.le16();
  const std::uint32_t compression = cursor.le32();
  return cursor.ok() && bits == 32 && compression == 0;
}

bool is_transparent(std::span<const std::byte> gif) {
  Cursor cursor(gif);
  cursor.skip(6);
  const std::uint16_t width = cursor.le16();
  const std::uint16_t height = cursor.le16();
  const std::uint8_t flags = cursor.u8();
  cursor.skip(2);
  cursor.skip(table_size(flags));
  bool transparent = false;
  while (cursor.ok()) {
    const std::uint8_t block = cursor.u8();
    if (block == 0x21) {  // extension; 0xF9: graphic control
      if (cursor.u8() == 0xF9) {
        cursor.skip(1);
        transparent = (cursor.u8() & 1U) != 0;
        cursor.skip(3);
      }
      skip_blocks(cursor);
      continue;
    }
    if (block != 0x2C) return false;
    cursor.skip(4);
    const std::uint16_t frame_width = cursor.le16();
    const std::uint16_t frame_height = cursor.le16();
    return transparent || frame_width < width || frame_height < height;
  }
  return false;
}

bool has_unread_alpha(std::span<const std::byte> tga) {
  Cursor cursor(tga);
  cursor.skip(1);
  const bool has_palette = cursor.u8() != 0;
  const unsigned type = cursor.u8() & 7U;  // 8 more: run-length encoded
  cursor.skip(4);
  const std::uint8_t palette_bits = cursor.u8();
  cursor.skip(8);
  const std::uint8_t bits = cursor.u8();
  const unsigned alpha_bits = cursor.u8() & 15U;
  if (type == 1)
    return has_palette && (palette_bits == 32 || (palette_bits == 16 && alpha_bits > 0));
  return type == 2 && bits == 16 && alpha_bits > 0;
}

bool has_default_bits(std::span<const std::byte> tiff) {
  constexpr std::uint16_t kBitsPerSample = 258;
  Cursor cursor(tiff);
  const bool big_endian = cursor.at("MM");
  const auto short_number = [&] { return big_endian ? cursor.be16() : cursor.le16(); };
  cursor.skip(2);
  if (short_number() != 42) return false;  // 43: BigTIFF, which came after the default
  cursor = Cursor(tiff);
  cursor.skip(4);
  const std::uint32_t directory = big_endian ? cursor.be32() : cursor.le32();
  if (directory < 8) return false;
  cursor.skip(directory - 8);
  const std::uint16_t count = short_number();
  for (unsigned i = 0; i < count && cursor.ok(); ++i) {
    if (short_number() == kBitsPerSample) return false;
    cursor.skip(10);
  }
  return cursor.ok();
}

}  // namespace gltfx::codec
