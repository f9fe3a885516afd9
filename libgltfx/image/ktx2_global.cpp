// SPDX-License-Identifier: Apache-2.0
// The global data of BasisLZ in a KTX2 file: codebooks, and the slices of images (KTX 2.0, "BasisLZ
// Global Data").
#include <array>
#include <numeric>
#include <string>
#include <utility>

#include "base/codes.hpp"
#include "image/ktx2_parts.hpp"

namespace gltfx::image {
namespace {

constexpr std::uint64_t kGlobalHeaderBytes = 20;
constexpr std::uint64_t kImageDescriptionBytes = 20;

// Number of images of all levels, or nothing when no file can have that many.
Checked all_images(const Ktx2& file) {
  Checked sum = 0;
  for (std::size_t level = 0; level < file.levels.size() && sum; ++level) {
    const Checked images = images_of_level(file, level);
    sum = images ? checked_add(*sum, *images) : std::nullopt;
  }
  return sum;
}

// The slices of an image, from the beginning of its level.
struct Slices {
  Ktx2Range first, second;

  explicit Slices(Cursor& at) : first(next(at)), second(next(at)) {}
  // Whether there are one or two slices inside the level.
  bool are_inside(const Ktx2Level& level, bool two) const {
    const auto inside = [&level](const Ktx2Range& slice) {
      return slice.length != 0 && fits(slice.offset, slice.length, level.length);
    };
    return inside(first) && (two ? inside(second) : second.length == 0);
  }
  void keep(Ktx2Level& level) const {
    level.first_slice = {level.offset + first.offset, first.length};
    level.second_slice = {level.offset + second.offset, second.length};
  }

 private:
  static Ktx2Range next(Cursor& at) {
    const std::uint64_t offset = at.le32();
    return {offset, at.le32()};
  }
};

// Images by level. Flags, which readers of still images ignore, are reported once.
class ImageCheck {
 public:
  explicit ImageCheck(Ktx2Reading& reading)
      : reading_(reading), two_(reading.file.channels.size() == 2) {}

  void check_all(Cursor at) {
    Ktx2& file = reading_.file;
    for (std::size_t index = 0; index < file.levels.size(); ++index) {
      const std::uint64_t images = images_of_level(file, index).value_or(0);
      for (std::uint64_t i = 0; i < images; ++i) {
        if (!check(at, index, i)) return;
      }
    }
  }

 private:
  bool check(Cursor& at, std::size_t index, std::uint64_t image) {
    Ktx2Level& level = reading_.file.levels[index];
    check_flags(at.le32(), index, image);
    const Slices slices(at);
    if (!slices.are_inside(level, two_)) {
      reading_.error(Code::KTX2_GLOBAL_DATA_INVALID,
                     "The slices of level " + std::to_string(index) + " are not inside it.");
      return false;
    }
    if (image == 0) slices.keep(level);
    return true;
  }

  void check_flags(std::uint32_t flags, std::size_t index, std::uint64_t image) {
    constexpr std::uint32_t kInterFrame = 2;
    const bool wrong = (flags & ~kInterFrame) != 0 || (flags != 0 && image == 0);
    if (!wrong || std::exchange(reported_, true)) return;
    reading_.tolerated_error(Code::KTX2_GLOBAL_DATA_INVALID,
                             "The flags of image " + std::to_string(image) + " of level " +
                                 std::to_string(index) + " are " + std::to_string(flags) +
                                 ", which is invalid.");
  }

  Ktx2Reading& reading_;
  bool two_;
  bool reported_ = false;
};

// After the descriptions of images, one after the other.
Ktx2Codebooks codebooks_at(std::uint64_t offset, const std::array<std::uint64_t, 4>& lengths) {
  Ktx2Codebooks books;
  books.endpoints = {offset, lengths[0]};
  books.selectors = {books.endpoints.end(), lengths[1]};
  books.slice_codes = {books.selectors.end(), lengths[2]};
  return books;
}

}  // namespace

void check_ktx2_global(Ktx2Reading& reading) {
  const auto bad = [&](std::string problem) {
    reading.error(Code::KTX2_GLOBAL_DATA_INVALID, std::move(problem));
  };
  Ktx2& file = reading.file;
  if (!reading.has_scheme(Ktx2Scheme::basis_lz)) {
    const bool vendor = file.scheme > static_cast<std::uint32_t>(Ktx2Scheme::zlib);
    if (reading.global.length != 0 && !vendor)
      bad("The image has global data, but no BasisLZ supercompression.");
    return;
  }
  if (reading.global.length < kGlobalHeaderBytes) return bad("The BasisLZ global data is missing.");
  Cursor at = reading.within(reading.global);
  const std::uint16_t endpoints = at.le16(), selectors = at.le16();
  std::array<std::uint64_t, 4> lengths{};  // of endpoints, selectors, tables and extended data
  for (std::uint64_t& length : lengths) length = at.le32();
  const std::uint64_t tables = std::accumulate(lengths.begin(), lengths.end(), kGlobalHeaderBytes);
  const Checked images = all_images(file);
  const Checked described = checked_mul(images.value_or(UINT64_MAX), kImageDescriptionBytes);
  const Checked total = described ? checked_add(*described, tables) : described;
  if (!total || *total != reading.global.length) {
    return bad("The length of the global data does not match its tables and images.");
  }
  if (endpoints == 0 || selectors == 0 || lengths[0] == 0 || lengths[1] == 0 || lengths[2] == 0) {
    return bad("The global data has an empty codebook or table.");
  }
  if (lengths[3] != 0) bad("The global data has extended data, which ETC1S does not use.");
  file.codebooks = codebooks_at(reading.global.offset + kGlobalHeaderBytes + *described, lengths);
  file.codebooks.endpoint_count = endpoints;
  file.codebooks.selector_count = selectors;
  ImageCheck(reading).check_all(at);
}

}  // namespace gltfx::image
