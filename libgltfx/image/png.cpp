// SPDX-License-Identifier: Apache-2.0
// PNG (W3C Portable Network Graphics, third edition), from the signature to the first IDAT. The
// checks cover the fields of IHDR and their combinations, PLTE and tRNS for the colour type, the
// checksums of IHDR and PLTE, names of critical chunks, the first bytes of the compressed data, and
// the presence of IEND.
#include <algorithm>
#include <array>
#include <bit>
#include <string_view>

#include <fmt/format.h>

#include "image/cursor.hpp"

namespace gltfx::image {
namespace {

constexpr std::uint32_t tag(const char (&name)[5]) {
  return static_cast<std::uint32_t>(name[0]) << 24 | static_cast<std::uint32_t>(name[1]) << 16 |
         static_cast<std::uint32_t>(name[2]) << 8 | static_cast<std::uint32_t>(name[3]);
}

// State of the chunks before the image data.
struct Chunks {
  Header header;
  std::uint32_t palette_entries = 0;
  bool transparency = false;
  bool opaque_entries = true;  // tRNS of a palette: all entries are 255
  bool grey_palette = false;
  bool two_level_palette = false;
};

// --- IHDR (section 11.2.1) ---

// Colour type: bit 0 palette, bit 1 colour, bit 2 alpha.
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

// Checks the bit depth of a colour type; `bits` is a power of two if it is valid.
void check_depth(Header& header, std::uint8_t color_type) {
  struct Depths {
    std::uint32_t bits;
    std::string_view text;
  };
  constexpr Depths kGrey{1 | 2 | 4 | 8 | 16, "1, 2, 4, 8 or 16"};
  constexpr Depths kPalette{1 | 2 | 4 | 8, "1, 2, 4 or 8"};
  constexpr Depths kOther{8 | 16, "8 or 16"};
  const Depths& depths = color_type == 0 ? kGrey : color_type == 3 ? kPalette : kOther;
  if (std::has_single_bit(header.bits) && (depths.bits & header.bits) != 0) return;
  doubt(header, fmt::format("The bit depth of the PNG is {}; for color type {} it must be {}.",
                            header.bits, color_type, depths.text));
}

// Compression and filter have one method, interlacing two.
void check_method(Header& header, std::string_view name, std::uint8_t method, std::uint8_t last) {
  if (method <= last) return;
  doubt(header, fmt::format("The {} method of the PNG is {}, which is unknown.", name, method));
}

void read_ihdr(Cursor at, Header& header) {
  header.width = at.be32();
  header.height = at.be32();
  header.bits = at.u8();
  const std::uint8_t color_type = at.u8();
  const std::uint8_t compression = at.u8(), filter = at.u8(), interlace = at.u8();
  header.interlaced = interlace != 0;
  header.grey = color_type == 0 || color_type == 4;
  header.two_level = color_type == 0 && header.bits == 1;
  constexpr std::uint32_t kGreatest = 0x7FFFFFFF;
  if (header.width == 0 || header.height == 0) doubt(header, "The PNG has a width or height of 0.");
  if (header.width > kGreatest || header.height > kGreatest) {
    doubt(header, "The PNG has a width or height above 2147483647.");
  }
  if (set_channels(header, color_type)) {
    check_depth(header, color_type);
  } else {
    doubt(header,
          fmt::format("The color type of the PNG is {}; it must be 0, 2, 3, 4 or 6.", color_type));
  }
  check_method(header, "compression", compression, 0);
  check_method(header, "filter", filter, 0);
  check_method(header, "interlace", interlace, 1);
}

// --- Chunks about colours ---

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

// --- Palette and transparency ---

constexpr std::uint32_t kMaxEntries = 256;

// Section 11.2.2. Only images with a palette need it; for others it is a suggestion.
void check_palette(std::uint32_t length, Chunks& chunks) {
  Header& header = chunks.header;
  const std::uint32_t entries = length / 3;
  const bool sound = length % 3 == 0 && entries != 0 && entries <= kMaxEntries;
  if (chunks.palette_entries != 0) doubt(header, "The PNG has two palettes.");
  if (!header.palette) {
    if (header.grey) remark(header, "The PNG is grayscale, but has a palette.", false);
    return;
  }
  if (!sound) {
    doubt(header,
          fmt::format(
              "The palette of the PNG has {} bytes; it must have 1 to 256 entries of 3 bytes.",
              length));
  } else if (header.bits < 8 && entries > 1U << header.bits) {
    remark(header,
           fmt::format("The palette of the PNG has {} entries; with {} bits it can have only {}.",
                       entries, header.bits, 1U << header.bits),
           false);
  }
}

// Three bytes an entry.
void read_palette(Cursor at, std::uint32_t length, Chunks& chunks) {
  check_palette(length, chunks);
  chunks.palette_entries = std::min(length / 3, kMaxEntries);
  chunks.grey_palette = chunks.two_level_palette = length >= 3;
  for (std::uint32_t entry = 0; entry < chunks.palette_entries; ++entry) {
    const std::array<std::uint8_t, 3> color{at.u8(), at.u8(), at.u8()};
    if (color[0] != color[1] || color[1] != color[2]) chunks.grey_palette = false;
    for (const std::uint8_t value : color) {
      if (value != 0 && value != 255) chunks.two_level_palette = false;
    }
  }
}

// Section 11.3.1.1: a byte for each of the first entries of a palette; otherwise one colour. Some
// readers refuse errors here that others skip.
void check_transparency(std::uint32_t length, Chunks& chunks) {
  Header& header = chunks.header;
  if (has_alpha(header.channels)) {
    return remark(header, "The PNG has both a tRNS chunk and an alpha channel.", true);
  }
  if (chunks.transparency) return remark(header, "The PNG has two tRNS chunks.", true);
  if (header.palette && chunks.palette_entries == 0) {
    return remark(header, "The tRNS chunk of the PNG is before its palette.", true);
  }
  const std::uint32_t color = header.channels == Channels::rgb ? 6 : 2;
  const bool sound =
      header.palette ? length >= 1 && length <= chunks.palette_entries : length == color;
  if (sound) return;
  remark(header,
         fmt::format("The tRNS chunk of the PNG has {} bytes; it must have {}.", length,
                     header.palette ? "at most one per palette entry"
                     : color == 6   ? "6"
                                    : "2"),
         true);
}

void read_transparency(Cursor at, std::uint32_t length, Chunks& chunks) {
  check_transparency(length, chunks);
  chunks.transparency = true;
  for (std::uint32_t entry = 0; entry < length && chunks.opaque_entries; ++entry) {
    chunks.opaque_entries = at.u8() == 255;
  }
}

// --- All chunks ---

// Section 5.4: the first letter is lower case if readers may skip an unknown chunk.
void check_name(std::uint32_t type, Header& header) {
  std::string name;
  for (int shift = 24; shift >= 0; shift -= 8) name += static_cast<char>(type >> shift & 0xFFU);
  const auto letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
  if (!std::all_of(name.begin(), name.end(), letter)) {
    return doubt(header, "The PNG has a chunk type with characters other than letters.");
  }
  const bool known = type == tag("IHDR") || type == tag("PLTE");
  if (!known && name.front() <= 'Z') {
    doubt(header, fmt::format("The PNG has the unknown critical chunk '{}'.", name));
  }
}

// Annex D: over the name and the content of a chunk.
std::uint32_t checksum(std::span<const std::byte> bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const std::byte byte : bytes) {
    crc ^= std::to_integer<std::uint32_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

// `at` is at the content of a chunk that is there as a whole.
void check_checksum(std::span<const std::byte> bytes, Cursor at, std::uint32_t type,
                    std::uint32_t length, Header& header) {
  const bool short_critical = type == tag("IHDR") || (type == tag("PLTE") && length <= 768);
  if (!short_critical) return;
  const std::uint32_t found = checksum(bytes.subspan(at.position() - 4, std::size_t{length} + 4));
  at.skip(length);
  if (at.be32() == found) return;
  doubt(header, fmt::format("The checksum of {} in the PNG is wrong.",
                            type == tag("IHDR") ? "IHDR" : "PLTE"));
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
  } else if (type == tag("PLTE")) {
    read_palette(at, length, chunks);
  } else if (type == tag("pHYs")) {
    const std::uint32_t across = at.be32();
    header.square_pixels = across == at.be32();
  } else if (type == tag("acTL")) {
    header.animated = true;
  }
}

// --- Image data and end ---

// The first bytes of a zlib stream (RFC 1950): deflate, a window of 32 KiB at most, no dictionary.
void check_stream(Cursor at, std::uint32_t length, Header& header) {
  if (length < 2) return;  // it continues in the next chunk
  const std::uint32_t method = at.u8(), flags = at.u8();
  const bool sound = (method & 0x0FU) == 8 && method >> 4U <= 7 && (flags & 0x20U) == 0 &&
                     (method << 8U | flags) % 31 == 0;
  if (at.ok() && !sound) {
    doubt(header, "The image data of the PNG has an invalid compression header.");
  }
}

// Whether the first IDAT ends inside the file and IEND exists. IEND is at the end of the file
// unless unread bytes follow. `at` is at the content of the IDAT.
bool has_end(std::span<const std::byte> bytes, Cursor at, std::uint32_t length) {
  using namespace std::literals;
  constexpr std::string_view kEnd = "\0\0\0\0IEND\xae\x42\x60\x82"sv;
  constexpr int kMaxChunks = 1 << 16;
  at.skip(std::uint64_t{length} + 4);
  if (at.ok() && Cursor(bytes.last(kEnd.size())).at(kEnd)) return true;
  for (int chunks = 0; chunks < kMaxChunks; ++chunks) {
    length = at.be32();
    const std::uint32_t type = at.be32();
    if (!at.ok()) return false;
    if (type == tag("IEND")) return true;
    at.skip(std::uint64_t{length} + 4);
  }
  return true;  // unknown
}

// A transparent colour adds an alpha channel. Without chunks about colour, the image is sRGB.
void finish(Chunks& chunks) {
  Header& header = chunks.header;
  if (header.primaries == Tag::none) header.primaries = Tag::srgb;
  if (header.transfer == Tag::none) header.transfer = Tag::srgb;
  if (header.palette) {
    if (chunks.palette_entries == 0) doubt(header, "The PNG uses a palette, but has none.");
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
  Header& header = chunks.header;
  header.format = Format::png;
  Cursor at(bytes);
  at.skip(8);
  for (bool first = true; at.ok(); first = false) {
    const std::uint32_t length = at.be32();
    const std::uint32_t type = at.be32();
    if (!at.ok()) break;
    if (first && type != tag("IHDR")) return invalid("The PNG does not start with IHDR.");
    if (type == tag("IDAT")) {
      finish(chunks);
      check_stream(at, length, header);
      if (!has_end(bytes, at, length)) doubt(header, "The PNG is truncated.");
      return header;
    }
    if (!first && type == tag("IHDR")) doubt(header, "The PNG has two IHDR chunks.");
    const std::uint32_t fixed = fixed_length(type);
    if (fixed != 0 && length != fixed) return invalid("The PNG has a chunk with a wrong length.");
    const Cursor content = at;
    at.skip(std::uint64_t{length} + 4);  // the checksum follows the content
    if (!at.ok()) break;
    check_name(type, header);
    check_checksum(bytes, content, type, length, header);
    read_chunk(content, type, length, chunks);
  }
  return unexpected_end();
}

}  // namespace gltfx::image
