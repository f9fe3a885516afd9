// SPDX-License-Identifier: Apache-2.0
// JPEG (ITU-T T.81), from SOI to the first frame header.
#include "image/cursor.hpp"
#include "image/formats.hpp"

namespace gltfx::image {
namespace {

// SOF0 to SOF15 without DHT (C4), JPG (C8) and DAC (CC), table B.1.
bool is_frame_header(std::uint8_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

// Markers without a segment: TEM and RST0 to RST7.
bool stands_alone(std::uint8_t marker) {
  return marker == 0x01 || (marker >= 0xD0 && marker <= 0xD7);
}

bool is_progressive(std::uint8_t marker) {
  return marker == 0xC2 || marker == 0xC6 || marker == 0xCA || marker == 0xCE;
}

HeaderResult read_frame_header(Cursor at, std::uint8_t marker) {
  Header header;
  header.format = Format::jpeg;
  header.bits = at.u8();
  header.height = at.be16();
  header.width = at.be16();
  const std::uint8_t components = at.u8();
  if (!at.ok()) return unexpected_end();
  if (header.width == 0 || header.height == 0) return invalid("The JPEG has no pixels.");
  if (components != 1 && components != 3) {
    return invalid("The JPEG has neither one nor three channels.");
  }
  header.channels = components == 1 ? Channels::luminance : Channels::rgb;
  header.interlaced = is_progressive(marker);
  return header;
}

}  // namespace

HeaderResult read_jpeg(std::span<const std::byte> bytes) {
  Cursor at(bytes);
  at.skip(2);  // SOI
  while (at.ok()) {
    if (at.u8() != 0xFF) {
      return at.ok() ? HeaderResult(invalid("The JPEG has something else where a marker must be."))
                     : HeaderResult(unexpected_end());
    }
    std::uint8_t marker = at.u8();
    while (at.ok() && marker == 0xFF) marker = at.u8();  // fill bytes
    if (!at.ok()) break;
    if (stands_alone(marker)) continue;
    const std::uint16_t length = at.be16();  // counts itself
    if (!at.ok()) break;
    if (length < 2) return invalid("A segment of the JPEG is shorter than its length field.");
    if (is_frame_header(marker)) return read_frame_header(at, marker);
    at.skip(length - 2U);
  }
  return unexpected_end();
}

}  // namespace gltfx::image
