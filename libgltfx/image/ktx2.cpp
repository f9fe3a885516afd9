// SPDX-License-Identifier: Apache-2.0
// The header and the index of a KTX2 file (KTX 2.0 sections 3.1 to 3.11).
#include "image/ktx2.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/codes.hpp"
#include "image/ktx2_parts.hpp"

namespace gltfx::image {
namespace {

constexpr std::uint64_t kIdentifierBytes = 12;

std::uint64_t le64(Cursor& at) {
  const std::uint64_t low = at.le32();
  return low | std::uint64_t{at.le32()} << 32U;
}

void read_fields(Cursor& at, Ktx2& file) {
  file.vk_format = at.le32();
  file.type_size = at.le32();
  file.width = at.le32();
  file.height = at.le32();
  file.depth = at.le32();
  file.layers = at.le32();
  file.faces = at.le32();
  file.level_count = at.le32();
  file.scheme = at.le32();
}

void check_fields(Ktx2Reading& reading) {
  const Ktx2& file = reading.file;
  const auto bad = [&](std::string problem) {
    reading.error(Code::KTX2_HEADER_INVALID, std::move(problem));
  };
  if (file.width == 0) bad("pixelWidth is 0.");
  if (file.depth != 0 && file.height == 0) bad("pixelDepth is not 0, but pixelHeight is 0.");
  if (file.faces != 1 && file.faces != 6) {
    bad("faceCount is " + std::to_string(file.faces) + "; it must be 1 or 6.");
  }
  if (file.faces == 6 && (file.width != file.height || file.depth != 0)) {
    bad("The faces of the cube map are not square.");
  }
  if (file.level_count > file.full_pyramid()) {
    bad("levelCount is " + std::to_string(file.level_count) + ", but " +
        std::to_string(file.full_pyramid()) + " levels lead down to one texel.");
  }
  if (file.vk_format == 0 && file.type_size != 1) bad("typeSize must be 1 if vkFormat is 0.");
  constexpr std::uint32_t kFirstVendor = 0x10000;
  constexpr std::uint32_t kLastVendor = 0x1FFFF;
  if (file.scheme > 3 && (file.scheme < kFirstVendor || file.scheme > kLastVendor)) {
    bad("supercompressionScheme " + std::to_string(file.scheme) + " is unknown.");
  }
}

// A range of the index if it is valid, otherwise an empty one.
Ktx2Range part(Ktx2Reading& reading, Ktx2Range range, std::string_view name,
               std::uint64_t alignment) {
  const auto bad = [&](std::string problem) {
    reading.error(Code::KTX2_INDEX_INVALID, std::string(name) + std::move(problem));
    return Ktx2Range();
  };
  if (range.length == 0)
    return range.offset == 0 ? range : bad(" has an offset, but a length of 0.");
  if (!fits(range.offset, range.length, reading.bytes.size())) {
    return bad(" is outside the file.");
  }
  if (range.offset % alignment != 0) {
    return bad(" has an offset that is not a multiple of " + std::to_string(alignment) + ".");
  }
  return range;
}

// The descriptor has no padding on either side, the global data is padded to 8 bytes. Readers that
// use the index ignore this. After other errors the start of the parts is unknown.
void check_gaps(Ktx2Reading& reading, std::uint64_t index_end) {
  const auto bad = [&](std::string problem) {
    reading.tolerated_error(Code::KTX2_INDEX_INVALID, std::move(problem));
  };
  if (reading.descriptor.length == 0 || !reading.file.errors.empty()) return;
  if (reading.descriptor.offset != index_end) {
    bad("The data format descriptor is not directly after the level index.");
  }
  std::uint64_t end = reading.descriptor.end();
  if (reading.metadata.length != 0) {
    if (reading.metadata.offset != end) {
      bad("The metadata is not directly after the data format descriptor.");
    }
    end = reading.metadata.end();
  }
  if (reading.global.length != 0 && reading.global.offset != (end + 7) / 8 * 8) {
    bad("The supercompression global data is not directly after the metadata.");
  }
}

// Each part follows the one before it (section 3.11).
void check_order(Ktx2Reading& reading, std::uint64_t index_end) {
  std::uint64_t end = index_end;
  for (const Ktx2Range& range : {reading.descriptor, reading.metadata, reading.global}) {
    if (range.length == 0) continue;
    if (range.offset < end) {
      reading.error(Code::KTX2_INDEX_INVALID, "Parts of the file overlap or are out of order.");
      return;
    }
    end = range.end();
  }
  check_gaps(reading, index_end);
}

void read_index(Cursor& at, Ktx2Reading& reading) {
  const auto range32 = [&at] {
    const std::uint64_t offset = at.le32();
    return Ktx2Range{offset, at.le32()};
  };
  const auto range64 = [&at] {
    const std::uint64_t offset = le64(at);
    return Ktx2Range{offset, le64(at)};
  };
  const Ktx2Range descriptor = range32();
  const Ktx2Range metadata = range32();
  const Ktx2Range global = range64();
  reading.descriptor = part(reading, descriptor, "The data format descriptor", 4);
  reading.metadata = part(reading, metadata, "The metadata", 4);
  reading.global = part(reading, global, "The supercompression global data", 8);
}

// As many levels as the extents allow; further declared levels have been reported.
bool read_levels(Cursor& at, Ktx2& file) {
  const std::uint32_t count = std::clamp(file.level_count, 1U, file.full_pyramid());
  for (std::uint32_t i = 0; i < count; ++i) {
    Ktx2Level level;
    level.offset = le64(at);
    level.length = le64(at);
    level.uncompressed = le64(at);
    if (!at.ok()) return false;
    file.levels.push_back(level);
  }
  return true;
}

Tag tag_of_transfer(std::uint8_t transfer) {
  if (transfer == kKtx2TransferSrgb) return Tag::srgb;
  return transfer == kKtx2TransferLinear ? Tag::linear : Tag::custom;
}

}  // namespace

std::uint32_t Ktx2::full_pyramid() const {
  const std::uint32_t greatest = std::max({width, height, depth, 1U});
  return static_cast<std::uint32_t>(std::bit_width(greatest));
}

bool Ktx2::is_sound() const {
  return described && std::all_of(errors.begin(), errors.end(),
                                  [](const Ktx2Error& error) { return error.tolerated; });
}

bool has_known_texels(const Ktx2& file) {
  const auto scheme = static_cast<Ktx2Scheme>(file.scheme);
  if (!file.is_sound()) return false;
  if (file.model == Ktx2Model::etc1s) return scheme == Ktx2Scheme::basis_lz;
  return file.model == Ktx2Model::uastc &&
         (scheme == Ktx2Scheme::none || scheme == Ktx2Scheme::zstd);
}

Ktx2 read_ktx2(std::span<const std::byte> bytes) {
  Ktx2 file;
  Ktx2Reading reading{bytes, file, {}, {}, {}, 0, {}, {}};
  Cursor at(bytes);
  at.skip(kIdentifierBytes);
  if (bytes.size() < kKtx2HeaderBytes) {
    reading.error(
        Code::IMAGE_UNEXPECTED_EOS,
        "The image ends after " + std::to_string(bytes.size()) + " bytes, inside its header.");
    return file;
  }
  read_fields(at, file);
  check_fields(reading);
  read_index(at, reading);
  if (!read_levels(at, file)) {
    reading.error(Code::IMAGE_UNEXPECTED_EOS, "The image ends inside its level index.");
    return file;
  }
  check_order(reading, kKtx2HeaderBytes + kKtx2LevelBytes * file.levels.size());
  read_ktx2_descriptor(reading);
  check_ktx2_format(reading);
  read_ktx2_metadata(reading);
  check_ktx2_levels(reading);
  check_ktx2_global(reading);
  return file;
}

Header header_of(const Ktx2& file) {
  Header header;
  header.format = Format::ktx2;
  header.width = file.width;
  header.height = file.height == 0 ? 1 : file.height;
  header.channels = file.contents.value_or(Channels::rgba);
  header.primaries = file.primaries == 0                     ? Tag::none
                     : file.primaries == kKtx2PrimariesBt709 ? Tag::srgb
                                                             : Tag::custom;
  header.transfer = tag_of_transfer(file.transfer);
  return header;
}

}  // namespace gltfx::image
