// SPDX-License-Identifier: Apache-2.0
// JPEG (ITU-T T.81), from SOI to the first frame header.
#include "image/cursor.hpp"
#include "image/formats.hpp"

namespace gltfx::image {
namespace {

// SOF0 to SOF15 without DHT (C4), JPG (C8) and DAC (CC), and DHP, table B.1.
bool is_frame_header(std::uint8_t marker) {
  if (marker == 0xDE) return true;
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

// Markers without a segment: TEM, RST0 to RST7, SOI and EOI. Fill bytes count with them.
bool stands_alone(std::uint8_t marker) {
  return marker == 0x01 || (marker >= 0xD0 && marker <= 0xD9) || marker == 0xFF;
}

bool is_progressive(std::uint8_t marker) {
  return marker == 0xC2 || marker == 0xC6 || marker == 0xCA || marker == 0xCE;
}

HeaderResult read_frame_header(Cursor at, std::uint8_t marker, Header header) {
  header.bits = at.u8();
  header.height = at.be16();
  header.width = at.be16();
  const std::uint8_t components = at.u8();
  if (!at.ok()) return unexpected_end();
  if (components != 1 && components != 3) {
    return invalid("The JPEG has neither one nor three channels.");
  }
  if (header.width == 0 || header.height == 0) header.doubt = "The JPEG has no pixels.";
  header.channels = components == 1 ? Channels::luminance : Channels::rgb;
  header.grey = components == 1;
  header.interlaced = is_progressive(marker);
  return header;
}

}  // namespace

// As decoders do it, bytes between segments are not held against a file.
HeaderResult read_jpeg(std::span<const std::byte> bytes) {
  Header header;
  header.format = Format::jpeg;
  Cursor at(bytes);
  at.skip(2);  // SOI
  while (at.ok()) {
    const std::uint8_t marker = at.u8();
    if (stands_alone(marker)) continue;
    const std::uint16_t length = at.be16();  // counts itself
    if (!at.ok()) break;
    if (length < 2) return invalid("A segment of the JPEG is shorter than its length field.");
    Cursor content = at;
    at.skip(length - 2U);
    if (at.ok() && is_frame_header(marker)) {
      if (length < 8) return invalid("The frame header of the JPEG is too short.");
      return read_frame_header(content, marker, header);
    }
    // APP2 of the ICC (specification ICC.1, annex B.4).
    if (marker == 0xE2 && content.at("ICC_PROFILE")) header.icc_profile = true;
  }
  return unexpected_end();
}

}  // namespace gltfx::image
