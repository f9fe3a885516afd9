// SPDX-License-Identifier: Apache-2.0
// PNG (W3C Portable Network Graphics, third edition), from the signature to the first IDAT.
#include <algorithm>
#include <array>

#include "image/cursor.hpp"
#include "image/formats.hpp"

namespace gltfx::image {
namespace {

constexpr std::uint32_t tag(const char (&name)[5]) {
  return static_cast<std::uint32_t>(name[0]) << 24 | static_cast<std::uint32_t>(name[1]) << 16 |
         static_cast<std::uint32_t>(name[2]) << 8 | static_cast<std::uint32_t>(name[3]);
}

// What the chunks before the image data have said so far.
struct Chunks {
  Header header;
  bool transparency = false;
  bool opaque_entries = true;  // tRNS of a palette: all entries are 255
  bool grey_palette = false;
  bool two_level_palette = false;
};

// Colour type (section 11.2.1): bit 0 palette, bit 1 colour, bit 2 alpha.
bool set_channels(Header& header, std::uint8_t color_type) {
  constexpr std::uint8_t kPalette = 3;
  switch (color_type) {
    case 0:
      header.channels = Channels::luminance;
      break;
    case 4:
      header.channels = Channels::luminance_alpha;
      break;
    case 6:
      header.channels = Channels::rgba;
      break;
    default:
      header.channels = Channels::rgb;
      header.palette = color_type == kPalette;
      return color_type == 2 || color_type == kPalette;
  }
  return true;
}

bool is_bit_depth(std::uint32_t bits) {
  return bits == 1 || bits == 2 || bits == 4 || bits == 8 || bits == 16;
}

void read_ihdr(Cursor at, Header& header) {
  header.width = at.be32();
  header.height = at.be32();
  header.bits = at.u8();
  const std::uint8_t color_type = at.u8();
  at.skip(2);  // compression and filter method: there is one of each
  header.interlaced = at.u8() != 0;
  header.grey = color_type == 0 || color_type == 4;
  header.two_level = color_type == 0 && header.bits == 1;
  if (!set_channels(header, color_type))
    header.doubt = "The colour type of the PNG does not exist.";
  if (!is_bit_depth(header.bits)) {
    header.doubt = "The bit depth of the PNG is none of 1, 2, 4, 8, 16.";
  }
  if (header.width == 0 || header.height == 0) header.doubt = "The PNG has no pixels.";
}

// Bytes of the chunks that have one length only; 0 for the others.
std::uint32_t fixed_length(std::uint32_t type) {
  if (type == tag("IHDR")) return 13;
  if (type == tag("cHRM")) return 32;
  if (type == tag("gAMA")) return 4;
  if (type == tag("pHYs")) return 9;
  return type == tag("sRGB") ? 1 : 0;
}

// Section 11.3.2.2; the values of sRGB with their usual rounding.
bool is_srgb_chromaticity(Cursor at) {
  constexpr std::array<std::uint32_t, 8> kSrgb{31270, 32900, 64000, 33000,
                                               30000, 60000, 15000, 6000};
  return std::all_of(kSrgb.begin(), kSrgb.end(),
                     [&](std::uint32_t wanted) { return at.be32() == wanted; });
}

Tag transfer_of_gamma(std::uint32_t gamma) {
  if (gamma == 45455) return Tag::srgb;
  return gamma == 100000 ? Tag::linear : Tag::custom;
}

// Section 11.2.2: three bytes an entry.
void read_palette(Cursor at, std::uint32_t length, Chunks& chunks) {
  chunks.grey_palette = chunks.two_level_palette = length >= 3;
  for (std::uint32_t entry = 0; entry < length / 3; ++entry) {
    const std::array<std::uint8_t, 3> color{at.u8(), at.u8(), at.u8()};
    if (color[0] != color[1] || color[1] != color[2]) chunks.grey_palette = false;
    for (const std::uint8_t value : color) {
      if (value != 0 && value != 255) chunks.two_level_palette = false;
    }
  }
}

// Section 11.3.1.1: a byte for each of the first entries of a palette; otherwise one colour.
void read_transparency(Cursor at, std::uint32_t length, Chunks& chunks) {
  chunks.transparency = true;
  for (std::uint32_t entry = 0; entry < length && chunks.opaque_entries; ++entry) {
    chunks.opaque_entries = at.u8() == 255;
  }
}

// sRGB and iCCP override gAMA and cHRM (section 4.3).
void read_chunk(Cursor at, std::uint32_t type, std::uint32_t length, Chunks& chunks) {
  Header& header = chunks.header;
  if (type == tag("IHDR")) {
    read_ihdr(at, header);
  } else if (type == tag("sRGB")) {
    header.primaries = header.transfer = Tag::srgb;
  } else if (type == tag("iCCP")) {
    header.primaries = header.transfer = Tag::custom;
    header.icc_profile = true;
  } else if (type == tag("gAMA") && header.transfer == Tag::none) {
    header.transfer = transfer_of_gamma(at.be32());
  } else if (type == tag("cHRM") && header.primaries == Tag::none) {
    header.primaries = is_srgb_chromaticity(at) ? Tag::srgb : Tag::custom;
  } else if (type == tag("tRNS")) {
    read_transparency(at, length, chunks);
  } else if (type == tag("PLTE") && header.palette) {
    read_palette(at, length, chunks);
  } else if (type == tag("pHYs")) {
    const std::uint32_t across = at.be32();
    header.square_pixels = across == at.be32();
  } else if (type == tag("acTL")) {
    header.animated = true;
  }
}

// A colour that counts as transparent makes an alpha channel of it. What says nothing about colour
// is sRGB.
void finish(Chunks& chunks) {
  Header& header = chunks.header;
  if (header.primaries == Tag::none) header.primaries = Tag::srgb;
  if (header.transfer == Tag::none) header.transfer = Tag::srgb;
  if (header.palette) {
    header.grey = chunks.grey_palette;
    header.two_level = chunks.two_level_palette;
  }
  if (!chunks.transparency) return;
  header.opaque = header.palette && chunks.opaque_entries;
  if (header.channels == Channels::rgb) header.channels = Channels::rgba;
  if (header.channels == Channels::luminance) header.channels = Channels::luminance_alpha;
}

}  // namespace

HeaderResult read_png(std::span<const std::byte> bytes) {
  Chunks chunks;
  chunks.header.format = Format::png;
  Cursor at(bytes);
  at.skip(8);
  for (bool first = true; at.ok(); first = false) {
    const std::uint32_t length = at.be32();
    const std::uint32_t type = at.be32();
    if (!at.ok()) break;
    if (first && type != tag("IHDR")) return invalid("The PNG does not begin with IHDR.");
    if (type == tag("IDAT")) {
      finish(chunks);
      return chunks.header;
    }
    const std::uint32_t fixed = fixed_length(type);
    if (fixed != 0 && length != fixed) return invalid("A chunk of the PNG has a wrong length.");
    Cursor content = at;
    at.skip(std::uint64_t{length} + 4);  // the checksum follows the content
    if (at.ok()) read_chunk(content, type, length, chunks);
  }
  return unexpected_end();
}

}  // namespace gltfx::image
