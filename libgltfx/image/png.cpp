// SPDX-License-Identifier: Apache-2.0
// PNG (W3C Portable Network Graphics, third edition), from the signature to the first IDAT.
#include <algorithm>
#include <array>
#include <string>

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
  bool srgb_chunk = false;
  bool transparency = false;
};

// Colour type (section 11.2.1): bit 0 palette, bit 1 colour, bit 2 alpha.
bool set_channels(Header& header, std::uint8_t color_type) {
  switch (color_type) {
    case 0:
      header.channels = Channels::luminance;
      return true;
    case 2:
      header.channels = Channels::rgb;
      return true;
    case 3:
      header.channels = Channels::rgb;
      header.palette = true;
      return true;
    case 4:
      header.channels = Channels::luminance_alpha;
      return true;
    case 6:
      header.channels = Channels::rgba;
      return true;
    default:
      return false;
  }
}

bool is_bit_depth(std::uint32_t bits) {
  return bits == 1 || bits == 2 || bits == 4 || bits == 8 || bits == 16;
}

// IHDR; the problem, or empty.
std::string read_ihdr(Cursor& at, Header& header) {
  header.width = at.be32();
  header.height = at.be32();
  header.bits = at.u8();
  const std::uint8_t color_type = at.u8();
  at.skip(2);  // compression and filter method: there is one of each
  header.interlaced = at.u8() != 0;
  if (!at.ok()) return {};
  if (header.width == 0 || header.height == 0) return "The PNG has no pixels.";
  if (!is_bit_depth(header.bits)) return "The bit depth of the PNG is none of 1, 2, 4, 8, 16.";
  if (!set_channels(header, color_type)) return "The colour type of the PNG does not exist.";
  return {};
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

void read_colour_chunk(Cursor at, std::uint32_t type, Chunks& chunks) {
  Header& header = chunks.header;
  if (type == tag("sRGB")) {
    chunks.srgb_chunk = true;
    header.primaries = header.transfer = Tag::srgb;
  } else if (type == tag("tRNS")) {
    chunks.transparency = true;
  } else if (type == tag("pHYs")) {
    header.square_pixels = at.be32() == at.be32();
  } else if (type == tag("acTL")) {
    header.animated = true;
  } else if (chunks.srgb_chunk) {
    return;  // sRGB overrides gAMA, cHRM and iCCP (section 4.3)
  } else if (type == tag("iCCP")) {
    header.primaries = header.transfer = Tag::custom;
  } else if (type == tag("gAMA")) {
    header.transfer = transfer_of_gamma(at.be32());
  } else if (type == tag("cHRM") && !is_srgb_chromaticity(at)) {
    header.primaries = Tag::custom;
  }
}

// A colour that counts as transparent makes an alpha channel of it. Palettes keep their name.
void apply_transparency(Chunks& chunks) {
  if (!chunks.transparency) return;
  Header& header = chunks.header;
  if (header.channels == Channels::rgb) header.channels = Channels::rgba;
  if (header.channels == Channels::luminance) header.channels = Channels::luminance_alpha;
}

}  // namespace

HeaderResult read_png(std::span<const std::byte> bytes) {
  Chunks chunks;
  chunks.header.format = Format::png;
  chunks.header.primaries = chunks.header.transfer = Tag::srgb;
  Cursor at(bytes);
  at.skip(8);
  for (bool first = true; at.ok(); first = false) {
    const std::uint32_t length = at.be32();
    const std::uint32_t type = at.be32();
    if (!at.ok()) break;
    if (first != (type == tag("IHDR"))) return invalid("The PNG does not begin with one IHDR.");
    if (type == tag("IDAT")) {
      apply_transparency(chunks);
      return chunks.header;
    }
    Cursor content = at;
    at.skip(std::uint64_t{length} + 4);  // the checksum follows the content
    if (!first) {
      read_colour_chunk(content, type, chunks);
      continue;
    }
    if (length != 13) return invalid("The IHDR of the PNG is not 13 bytes long.");
    const std::string problem = read_ihdr(content, chunks.header);
    if (!problem.empty()) return invalid(problem);
  }
  return unexpected_end();
}

}  // namespace gltfx::image
