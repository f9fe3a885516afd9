// SPDX-License-Identifier: Apache-2.0
// The levels of a KTX2 file (KTX 2.0 sections 3.9 and 3.12).
#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "base/codes.hpp"
#include "image/ktx2_parts.hpp"

namespace gltfx::image {
namespace {

constexpr std::uint32_t kZstdMagic = 0xFD2FB528;
constexpr std::uint8_t kRgbsda = 1, kFirstBlockModel = 128;

bool is_block_model(const Ktx2Reading& reading) { return reading.color_model >= kFirstBlockModel; }

// Bytes of a texel block, or 0 if unknown: PVRTC has special extents, and 4:2:2 texels have several
// planes.
std::uint64_t block_size(const Ktx2Reading& reading) {
  constexpr std::uint8_t kPvrtc = 164, kPvrtc2 = 165;
  const std::uint8_t model = reading.color_model;
  if (reading.file.model == Ktx2Model::uastc || reading.file.model == Ktx2Model::astc) return 16;
  const bool regular =
      model == kRgbsda || (is_block_model(reading) && model != kPvrtc && model != kPvrtc2);
  return regular && reading.plane_bytes[1] == 0 ? reading.plane_bytes[0] : 0;
}

// Bytes of a level before supercompression.
Checked level_bytes(const Ktx2Reading& reading, std::size_t level) {
  const Ktx2& file = reading.file;
  const auto blocks = [&](std::uint32_t extent, std::size_t axis) {
    const std::uint64_t size = std::uint64_t{file.block[axis]} + 1;
    return (level_extent(extent, level) + size - 1) / size;
  };
  const Checked images = images_of_level(file, level);
  const Checked flat = checked_mul(blocks(file.width, 0), blocks(file.height, 1));
  const Checked all = images && flat ? checked_mul(*flat, *images) : std::nullopt;
  return all ? checked_mul(*all, block_size(reading)) : std::nullopt;
}

// The first two bytes of a ZLIB stream (RFC 1950).
bool is_zlib(std::uint32_t begin) { return (begin >> 8U & 0x0FU) == 8 && begin % 31 == 0; }

class LevelCheck {
 public:
  explicit LevelCheck(Ktx2Reading& reading) : reading_(reading), file_(reading.file) {}

  void check(std::size_t index) {
    const Ktx2Level& level = file_.levels[index];
    if (level.length == 0) return bad(index, "has a length of 0.");
    if (!fits(level.offset, level.length, reading_.bytes.size())) {
      return bad(index, "is outside the file.");
    }
    const std::uint64_t behind = std::max(
        {reading_.descriptor.end(), reading_.metadata.end(), reading_.global.end(), index_end()});
    if (level.offset < behind) return bad(index, "is inside the header.");
    check_alignment(index, level);
    check_order(index, level);
    check_length(index, level);
  }

 private:
  std::uint64_t index_end() const {
    return kKtx2HeaderBytes + kKtx2LevelBytes * file_.levels.size();
  }

  void bad(std::size_t index, std::string problem) {
    reading_.error(Code::KTX2_LEVEL_INVALID, "Level " + std::to_string(index) + ' ' + problem);
  }

  // Only bytes that are not supercompressed are aligned, to texel blocks and to 4.
  void check_alignment(std::size_t index, const Ktx2Level& level) {
    const std::uint64_t alignment = std::lcm(std::max<std::uint64_t>(block_size(reading_), 1), 4);
    if (reading_.has_scheme(Ktx2Scheme::none) && level.offset % alignment != 0) {
      bad(index, "has an offset that is not a multiple of " + std::to_string(alignment) + '.');
    }
  }

  // The smallest level comes first in the file.
  void check_order(std::size_t index, const Ktx2Level& level) {
    if (index == 0) return;
    const Ktx2Level& larger = file_.levels[index - 1];
    if (fits(larger.offset, larger.length, reading_.bytes.size()) &&
        larger.offset < level.offset + level.length) {
      bad(index, "is not before the next larger level.");
    }
  }

  void check_length(std::size_t index, const Ktx2Level& level) {
    if (reading_.has_scheme(Ktx2Scheme::basis_lz)) {
      if (level.uncompressed != 0)
        bad(index, "has an uncompressed length; for BasisLZ it must be 0.");
      return;
    }
    if (reading_.has_scheme(Ktx2Scheme::none) && level.uncompressed != level.length) {
      return bad(index, "has two different lengths, but is not supercompressed.");
    }
    const bool right = block_size(reading_) != 0
                           ? level_bytes(reading_, index) == level.uncompressed
                           : level.uncompressed % elements_of(file_) == 0;
    if (!right) {
      return bad(index, "has " + std::to_string(level.uncompressed) +
                            " bytes, which does not match its dimensions.");
    }
    Cursor at = reading_.at(level.offset);
    if (reading_.has_scheme(Ktx2Scheme::zstd) && at.le32() != kZstdMagic) {
      bad(index, "is not a Zstandard frame.");
    }
    if (reading_.has_scheme(Ktx2Scheme::zlib) && !is_zlib(at.be16())) {
      bad(index, "is not a ZLIB stream.");
    }
  }

  Ktx2Reading& reading_;
  const Ktx2& file_;
};

}  // namespace

std::uint64_t elements_of(const Ktx2& file) {
  return std::uint64_t{std::max(file.layers, 1U)} * std::max(file.faces, 1U);
}

Checked images_of_level(const Ktx2& file, std::size_t level) {
  return checked_mul(elements_of(file), level_extent(file.depth, level));
}

void check_ktx2_levels(Ktx2Reading& reading) {
  const Ktx2& file = reading.file;
  if (file.level_count == 0 && is_block_model(reading)) {
    reading.error(Code::KTX2_HEADER_INVALID,
                  "levelCount is 0, but mipmaps cannot be generated for block-compressed data.");
  }
  if (file.height == 0 && is_block_model(reading)) {
    reading.error(Code::KTX2_HEADER_INVALID,
                  "pixelHeight is 0, which is not allowed for block-compressed data.");
  }
  LevelCheck check(reading);
  for (std::size_t i = 0; i < file.levels.size(); ++i) check.check(i);
}

}  // namespace gltfx::image
