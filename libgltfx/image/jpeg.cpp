// SPDX-License-Identifier: Apache-2.0
// JPEG (ITU-T T.81), from SOI to the first scan header. The checks cover the coding process, the
// frame header, tables before the first scan, and the header of that scan.
#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "image/cursor.hpp"

namespace gltfx::image {
namespace {

// --- Segments ---

struct Segment {
  std::uint8_t marker = 0;
  std::uint16_t length = 0;  // counts itself, not the marker
  bool whole = false;        // the bytes do not end inside it
  Cursor content;
};

// Markers without a segment: TEM, RST0 to RST7, SOI and EOI.
bool stands_alone(std::uint8_t marker) {
  return marker == 0x01 || (marker >= 0xD0 && marker <= 0xD9);
}

// As in decoders, bytes between segments are ignored; `loose` says that there were some.
std::optional<Segment> next_segment(Cursor& at, std::span<const std::byte> bytes, bool& loose) {
  bool fill = false;
  while (at.ok()) {
    const std::uint8_t marker = at.u8();
    if (marker == 0xFF) {
      fill = true;
      continue;
    }
    if (!at.ok()) break;
    loose = loose || !fill || marker == 0;
    fill = false;
    if (stands_alone(marker)) continue;
    const std::uint16_t length = at.be16();
    if (!at.ok()) break;
    const std::size_t begin = at.position();
    if (length >= 2) at.skip(length - 2U);
    return Segment{marker, length, at.ok(), Cursor(bytes.subspan(begin, at.position() - begin))};
  }
  return std::nullopt;
}

// --- Tables (sections B.2.4.1 and B.2.4.2) ---

struct Component {
  std::uint8_t id = 0, across = 0, down = 0, table = 0;
};

struct Jpeg {
  Header header;
  std::uint8_t process = 0;  // its frame marker; 0 before the frame
  std::vector<Component> components;
  std::array<bool, 4> quantisation{}, dc{}, ac{};
  bool loose = false;  // the segments are not certain

  void refuse(std::string problem) {
    if (!loose) doubt(header, std::move(problem));
  }
};

void read_quantisation(Cursor at, Jpeg& jpeg) {
  while (at.left() > 0) {
    const std::uint8_t kind = at.u8();
    const std::uint32_t precision = kind >> 4U, id = kind & 0x0FU;
    at.skip(precision == 0 ? 64 : 128);
    if (precision > 1 || id > 3 || !at.ok()) {
      return jpeg.refuse("The JPEG has an invalid quantization table.");
    }
    jpeg.quantisation[id] = true;
  }
}

// Whether codes of these lengths form a prefix code; none consists of ones only (section C.2).
bool is_prefix_code(const std::array<std::uint32_t, 16>& counts, std::uint32_t left) {
  std::uint32_t code = 0;
  for (std::size_t i = 0; i < counts.size() && left > 0; ++i, code <<= 1U) {
    code += counts[i];
    left -= counts[i];
    if (code >= 2U << i) return false;
  }
  return true;
}

void read_huffman(Cursor at, Jpeg& jpeg) {
  while (at.left() > 0) {
    const std::uint8_t kind = at.u8();
    const std::uint32_t table_class = kind >> 4U, id = kind & 0x0FU;
    std::array<std::uint32_t, 16> counts{};
    std::uint32_t sum = 0;
    for (std::uint32_t& count : counts) {
      count = at.u8();
      sum += count;
    }
    bool symbols = true;  // symbols of DC are numbers of bits
    for (std::uint32_t i = 0; i < sum; ++i)
      symbols = (at.u8() <= 15 || table_class != 0) && symbols;
    if (table_class > 1 || id > 3 || sum > 256 || !at.ok() || !is_prefix_code(counts, sum) ||
        !symbols) {
      return jpeg.refuse("The JPEG has an invalid Huffman table.");
    }
    (table_class == 0 ? jpeg.dc : jpeg.ac)[id] = true;
  }
}

// --- Frame (section B.2.2) ---

// SOF0 to SOF15 without DHT (C4), JPG (C8) and DAC (CC), and DHP, table B.1.
bool is_frame_header(std::uint8_t marker) {
  if (marker == 0xDE) return true;
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

bool is_progressive(std::uint8_t marker) {
  return marker == 0xC2 || marker == 0xC6 || marker == 0xCA || marker == 0xCE;
}

bool is_arithmetic(std::uint8_t marker) { return marker == 0xC9 || marker == 0xCA; }

void check_process(Jpeg& jpeg) {
  const bool common = jpeg.process <= 0xC2 || is_arithmetic(jpeg.process);
  if (!common) jpeg.refuse("The JPEG is lossless or hierarchical, which loaders do not support.");
  if (is_arithmetic(jpeg.process)) {
    remark(jpeg.header, "The JPEG uses arithmetic coding, which browsers do not support.", true);
  }
}

void read_components(Cursor at, std::uint8_t count, std::uint16_t length, Jpeg& jpeg) {
  if (length != 8U + 3U * count) {
    return jpeg.refuse(fmt::format(
        "The length of the JPEG frame header does not match its {} components.", count));
  }
  for (std::uint8_t i = 0; i < count; ++i) {
    const std::uint8_t id = at.u8(), sampling = at.u8(), table = at.u8();
    const Component component{id, static_cast<std::uint8_t>(sampling >> 4U),
                              static_cast<std::uint8_t>(sampling & 0x0FU), table};
    const auto possible = [](std::uint8_t factor) { return factor >= 1 && factor <= 4; };
    if (!possible(component.across) || !possible(component.down)) {
      jpeg.refuse("The JPEG has a sampling factor that is not between 1 and 4.");
    }
    if (table > 3) jpeg.refuse("The JPEG has a component with a quantization table index above 3.");
    jpeg.components.push_back(component);
  }
}

// An error if the image cannot be described.
std::optional<HeaderError> read_frame_header(Segment segment, Jpeg& jpeg) {
  Header& header = jpeg.header;
  Cursor& at = segment.content;
  if (segment.length < 8) return invalid("The JPEG frame header is too short.");
  header.bits = at.u8();
  header.height = at.be16();
  header.width = at.be16();
  const std::uint8_t components = at.u8();
  if (components != 1 && components != 3) {
    HeaderError error = invalid(fmt::format("The JPEG has {} channels{}; it must have 1 or 3.",
                                            components, components == 4 ? " (CMYK)" : ""));
    error.cmyk = components == 4;
    return error;
  }
  jpeg.process = segment.marker;
  header.channels = components == 1 ? Channels::luminance : Channels::rgb;
  header.grey = components == 1;
  header.interlaced = is_progressive(segment.marker);
  if (header.width == 0) {
    doubt(header, "The JPEG has a width or height of 0.");
  } else if (header.height == 0) {
    doubt(header,
          "The JPEG frame header has a height of 0, and loaders do not read it from elsewhere.");
  }
  check_process(jpeg);
  if (header.bits != 8) {
    jpeg.refuse(
        fmt::format("The JPEG has {} bits per channel; loaders only support 8.", header.bits));
  }
  read_components(at, components, segment.length, jpeg);
  return std::nullopt;
}

// --- Scan (section B.2.3) ---

// The component of a scan with its tables: whether they have been defined.
void check_scan_component(const Component& component, std::uint8_t tables, bool dc, bool ac,
                          Jpeg& jpeg) {
  if (component.table <= 3 && !jpeg.quantisation[component.table]) {
    jpeg.refuse("The first scan of the JPEG uses a missing quantization table.");
  }
  if (is_arithmetic(jpeg.process)) return;
  const std::uint32_t dc_table = tables >> 4U, ac_table = tables & 0x0FU;
  if (dc_table > 3 || ac_table > 3) {
    jpeg.refuse("The first scan of the JPEG has a Huffman table index above 3.");
  } else if ((dc && !jpeg.dc[dc_table]) || (ac && !jpeg.ac[ac_table])) {
    remark(jpeg.header, "The first scan of the JPEG uses a missing Huffman table.", true);
  }
}

// Which coefficients a scan holds: first, last, and two shifts of their bits.
void check_band(const std::array<std::uint8_t, 3>& band, std::uint8_t components, Jpeg& jpeg) {
  const std::uint32_t first = band[0], last = band[1];
  const std::uint32_t high = band[2] >> 4U, low = band[2] & 0x0FU;
  if (!is_progressive(jpeg.process)) {
    if (first != 0 || last != 63 || band[2] != 0) {
      remark(jpeg.header, "The scan of the JPEG does not have all coefficients.", true);
    }
    return;
  }
  const bool dc_alone = first == 0 && last == 0;
  const bool ac_alone = first > 0 && first <= last && last <= 63 && components == 1;
  if ((!dc_alone && !ac_alone) || low > 13 || (high != 0 && low + 1 != high)) {
    jpeg.refuse("The first scan of the JPEG has an invalid range of coefficients.");
  }
}

void check_scan(Segment segment, Jpeg& jpeg) {
  Cursor& at = segment.content;
  const std::uint8_t count = at.u8();
  if (count < 1 || count > jpeg.components.size() || segment.length != 6U + 2U * count) {
    return jpeg.refuse("The first scan of the JPEG has an invalid header.");
  }
  Cursor behind = at;
  behind.skip(2U * count);
  const std::array<std::uint8_t, 3> band{behind.u8(), behind.u8(), behind.u8()};
  const bool progressive = is_progressive(jpeg.process);
  std::uint32_t blocks = 0;
  for (std::uint8_t i = 0; i < count; ++i) {
    const std::uint8_t id = at.u8(), tables = at.u8();
    const auto found = std::find_if(jpeg.components.begin(), jpeg.components.end(),
                                    [id](const Component& each) { return each.id == id; });
    if (found == jpeg.components.end()) {
      return jpeg.refuse("The first scan of the JPEG uses a missing component.");
    }
    check_scan_component(*found, tables, !progressive || band[0] == 0, !progressive || band[0] != 0,
                         jpeg);
    blocks += std::uint32_t{found->across} * found->down;
  }
  constexpr std::uint32_t kMaxBlocks = 10;
  if (count > 1 && blocks > kMaxBlocks) {
    jpeg.refuse(fmt::format(
        "The sampling factors of the JPEG sum to {} blocks; at most 10 are allowed.", blocks));
  }
  check_band(band, count, jpeg);
}

// Reads a segment before the first scan, except frames.
void read_segment(const Segment& segment, Jpeg& jpeg) {
  if (segment.marker == 0xDB) read_quantisation(segment.content, jpeg);
  if (segment.marker == 0xC4) read_huffman(segment.content, jpeg);
  // APP2 of the ICC (specification ICC.1, annex B.4).
  if (segment.marker == 0xE2 && segment.content.at("ICC_PROFILE")) jpeg.header.icc_profile = true;
}

}  // namespace

HeaderResult read_jpeg(std::span<const std::byte> bytes) {
  Jpeg jpeg;
  jpeg.header.format = Format::jpeg;
  Cursor at(bytes);
  at.skip(2);  // SOI
  while (const std::optional<Segment> segment = next_segment(at, bytes, jpeg.loose)) {
    const bool framed = jpeg.process != 0;
    if (segment->length < 2 && !framed) {
      return invalid("A segment of the JPEG is shorter than its length field.");
    }
    if (segment->length < 2 || !segment->whole) break;
    if (framed && segment->marker == 0xDA) {
      check_scan(*segment, jpeg);
      return jpeg.header;
    }
    if (is_frame_header(segment->marker)) {
      if (framed) jpeg.refuse("The JPEG has two frame headers.");
      if (framed) continue;
      if (auto error = read_frame_header(*segment, jpeg)) return *error;
    } else {
      read_segment(*segment, jpeg);
    }
  }
  if (jpeg.process == 0) return unexpected_end();
  jpeg.refuse("The JPEG ends before its first scan.");
  return jpeg.header;
}

}  // namespace gltfx::image
