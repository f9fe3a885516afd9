// SPDX-License-Identifier: Apache-2.0
// The data format descriptor and the metadata of a KTX2 file.
#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "image/ktx2_parts.hpp"

namespace gltfx::image {
namespace {

// --- Data format descriptor (Khronos Data Format 1.3, sections 3 to 5) ---

constexpr std::uint64_t kBlockHeaderBytes = 24;
constexpr std::uint64_t kSampleBytes = 16;

Ktx2Model model_of(std::uint8_t value) {
  switch (value) {
    case 162:
      return Ktx2Model::astc;
    case 163:
      return Ktx2Model::etc1s;
    case 166:
      return Ktx2Model::uastc;
    default:
      return Ktx2Model::other;
  }
}

// Channels by the ids of the samples: RGB 0, RRR 3, GGG 4, AAA 15.
std::optional<Channels> contents_of_etc1s(const std::vector<std::uint8_t>& ids) {
  using Ids = std::vector<std::uint8_t>;
  if (ids == Ids{0}) return Channels::rgb;
  if (ids == Ids{0, 15}) return Channels::rgba;
  if (ids == Ids{3}) return Channels::red;
  if (ids == Ids{3, 4}) return Channels::red_green;
  return std::nullopt;
}

// RGB 0, RGBA 3, RRR 4, RG 6.
std::optional<Channels> contents_of_uastc(const std::vector<std::uint8_t>& ids) {
  if (ids.size() != 1) return std::nullopt;
  switch (ids.front()) {
    case 0:
      return Channels::rgb;
    case 3:
      return Channels::rgba;
    case 4:
      return Channels::red;
    case 6:
      return Channels::red_green;
    default:
      return std::nullopt;
  }
}

void read_samples(Cursor& at, std::uint64_t count, Ktx2Reading& reading) {
  Ktx2& file = reading.file;
  for (std::uint64_t i = 0; i < count && at.ok(); ++i) {
    Ktx2Sample sample;
    sample.offset = at.le16();
    sample.bits = at.u8() + 1U;
    const std::uint8_t type = at.u8();
    sample.channel = type & 0x0FU;
    sample.is_signed = (type & 0x40U) != 0;
    sample.is_float = (type & 0x80U) != 0;
    at.skip(12);  // position, least and greatest value
    file.channels.push_back(sample.channel);
    reading.samples.push_back(sample);
  }
  if (file.model == Ktx2Model::etc1s) file.contents = contents_of_etc1s(file.channels);
  if (file.model == Ktx2Model::uastc) file.contents = contents_of_uastc(file.channels);
}

// A basic block: vendor and type 0, version 2, a size that holds whole samples.
bool is_basic_block(Cursor& at, std::uint64_t room, std::uint64_t& size) {
  const std::uint32_t kind = at.le32();
  const std::uint16_t version = at.le16();
  size = at.le16();
  return kind == 0 && version == 2 && size >= kBlockHeaderBytes && size <= room &&
         (size - kBlockHeaderBytes) % kSampleBytes == 0;
}

// ETC1S and UASTC: blocks of 4 by 4 texels, and samples of whole blocks. Earlier editions of the
// specification wrote no bytes of planes for supercompressed data.
void check_universal_blocks(Ktx2Reading& reading) {
  const Ktx2& file = reading.file;
  const bool etc1s = file.model == Ktx2Model::etc1s;
  if (!etc1s && file.model != Ktx2Model::uastc) return;
  if (file.block != std::array<std::uint8_t, 4>{3, 3, 0, 0}) {
    reading.error(Code::KTX2_DESCRIPTOR_INVALID, "The texel blocks are not 4x4.");
  }
  const std::uint32_t bytes = etc1s ? 8 : 16;
  std::uint32_t offset = 0;
  for (const Ktx2Sample& sample : reading.samples) {
    if (sample.offset != offset || sample.bits != bytes * 8) {
      return reading.tolerated_error(
          Code::KTX2_DESCRIPTOR_INVALID,
          fmt::format("The samples are not {} contiguous bits each.", bytes * 8));
    }
    offset += sample.bits;
  }
  const std::uint32_t plane = reading.plane_bytes[0];
  if (plane != bytes && (plane != 0 || reading.has_scheme(Ktx2Scheme::none))) {
    reading.tolerated_error(
        Code::KTX2_DESCRIPTOR_INVALID,
        fmt::format("bytesPlane0 is {}; it must be {}, the size of a texel block.", plane, bytes));
  }
}

// --- Metadata (KTX 2.0 section 3.11.4) ---

std::string_view text_at(const Ktx2Reading& reading, std::uint64_t offset, std::uint64_t length) {
  return {reinterpret_cast<const char*>(reading.bytes.data()) + offset,
          static_cast<std::size_t>(length)};
}

void keep_value(std::string_view key, std::string_view value, Ktx2& file) {
  if (!value.empty() && value.back() == '\0') value.remove_suffix(1);
  if (key == "KTXorientation") file.orientation = std::string(value);
  if (key == "KTXswizzle") file.swizzle = std::string(value);
}

// Keys whose presence or value the format restricts, and that no rule of glTF checks. Each occurs
// at most once, since repeated keys end the metadata.
void check_value(std::string_view key, std::string_view value, Ktx2Reading& reading) {
  if (!value.empty() && value.back() == '\0') value.remove_suffix(1);
  const bool mapping =
      key == "KTXglFormat" || key == "KTXdxgiFormat__" || key == "KTXmetalPixelFormat";
  if (mapping && reading.file.vk_format != 0) {
    reading.tolerated_error(Code::KTX2_METADATA_INVALID,
                            fmt::format("{} is only allowed if vkFormat is 0.", key));
  }
  if (key == "KTXastcDecodeMode" && value != "rgb9e5" && value != "unorm8") {
    reading.tolerated_error(Code::KTX2_METADATA_INVALID,
                            "KTXastcDecodeMode is neither rgb9e5 nor unorm8.");
  }
}

}  // namespace

void read_ktx2_descriptor(Ktx2Reading& reading) {
  const auto bad = [&](std::string problem) {
    reading.error(Code::KTX2_DESCRIPTOR_INVALID, std::move(problem));
  };
  Ktx2& file = reading.file;
  const Ktx2Range range = reading.descriptor;
  if (range.length == 0) {
    // A wrong index has been reported.
    const bool reported =
        std::any_of(file.errors.begin(), file.errors.end(),
                    [](const auto& error) { return error.code == Code::KTX2_INDEX_INVALID; });
    if (!reported) bad("The image has no data format descriptor.");
    return;
  }
  Cursor at = reading.within(range);
  const std::uint32_t total = at.le32();
  if (total != range.length) bad("The data format descriptor has the wrong length.");
  std::uint64_t size = 0;
  if (range.length < 4 + kBlockHeaderBytes || !is_basic_block(at, range.length - 4, size)) {
    bad("The data format descriptor does not start with a basic block.");
    return;
  }
  reading.color_model = at.u8();
  file.model = model_of(reading.color_model);
  file.primaries = at.u8();
  file.transfer = at.u8();
  file.premultiplied = (at.u8() & 1U) != 0;
  file.block = {at.u8(), at.u8(), at.u8(), at.u8()};
  reading.plane_bytes = {at.u8(), at.u8()};
  at.skip(6);  // further planes
  read_samples(at, (size - kBlockHeaderBytes) / kSampleBytes, reading);
  file.described = true;
  if (file.channels.empty()) bad("The data format descriptor has no samples.");
  check_universal_blocks(reading);
}

void read_ktx2_metadata(Ktx2Reading& reading) {
  const auto bad = [&](std::string problem) {
    reading.error(Code::KTX2_METADATA_INVALID, std::move(problem));
  };
  Cursor at = reading.within(reading.metadata);
  std::string_view before;
  while (at.left() > 0) {
    const std::uint64_t length = at.le32();
    const std::uint64_t begin = reading.metadata.offset + at.position();
    if (!at.ok() || length > at.left()) return bad("A metadata entry exceeds the metadata.");
    const std::string_view entry = text_at(reading, begin, length);
    const std::size_t end = entry.find('\0');
    if (end == std::string_view::npos || end == 0) return bad("A metadata entry has no key.");
    const std::string_view key = entry.substr(0, end);
    if (!before.empty() && key <= before) {
      return bad("The metadata keys are not sorted or not unique.");
    }
    before = key;
    const std::string_view value = entry.substr(end + 1);
    keep_value(key, value, reading.file);
    check_value(key, value, reading);
    at.skip(length);
    at.skip(std::min<std::uint64_t>((4 - length % 4) % 4, at.left()));
  }
  if (reading.metadata.length % 4 != 0) {
    reading.tolerated_error(Code::KTX2_METADATA_INVALID,
                            "The metadata does not end with the padding of its last entry.");
  }
}

}  // namespace gltfx::image
