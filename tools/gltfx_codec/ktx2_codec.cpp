// SPDX-License-Identifier: Apache-2.0
// KTX2 images with BasisLZ/ETC1S or UASTC, with or without Zstandard: the first image of a level. A
// request without pixels checks whether the bytes are valid, so it decodes all levels.
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <zstd.h>

#include "basis_etc1s.hpp"
#include "basis_slice.hpp"
#include "image/ktx2.hpp"
#include "image_decode.hpp"
#include "uastc_block.hpp"

namespace gltfx::codec {
namespace {

using image::Channels;
using image::Ktx2;
using image::Ktx2Level;
using image::Ktx2Model;
using image::Ktx2Range;

DecodeError corrupt(std::string message) { return {ErrorKind::malformed, std::move(message)}; }

std::string level_name(std::size_t level) { return "Level " + std::to_string(level); }

struct Extent {
  std::uint32_t width, height;
  std::uint64_t texels() const { return std::uint64_t{width} * height; }
  std::size_t blocks_across() const { return blocks_along(width); }
  std::size_t blocks() const { return blocks_across() * blocks_along(height); }
};

// Writes the next row of blocks. False if the bytes are corrupt.
using NextRow = std::function<bool(std::span<Texel> texels)>;

// --- BasisLZ ---

struct Basis {
  Etc1sCodebooks books;
  Etc1sSliceCodes codes;
};

// A level from its slices, the second one as a separate channel.
class BasisRows {
 public:
  BasisRows(const Basis& basis, std::span<const std::byte> first, std::span<const std::byte> second,
            std::size_t second_channel, const Extent& extent)
      : books_(basis.books), second_channel_(second_channel), blocks_(extent.blocks_across()) {
    first_.emplace(basis.codes, basis.books, first, blocks_.size());
    if (!second.empty()) second_.emplace(basis.codes, basis.books, second, blocks_.size());
  }

  bool next(std::span<Texel> texels) {
    if (!first_->next_row(blocks_)) return false;
    write(texels, [this](const Etc1sBlock& block, const BlockTexels& to) {
      write_etc1s_colors(books_.endpoints[block.endpoint], books_.selectors[block.selector], to);
    });
    if (!second_) return true;
    if (!second_->next_row(blocks_)) return false;
    write(texels, [this](const Etc1sBlock& block, const BlockTexels& to) {
      write_etc1s_channel(books_.endpoints[block.endpoint], books_.selectors[block.selector],
                          second_channel_, to);
    });
    return true;
  }

 private:
  template <typename Write>
  void write(std::span<Texel> texels, const Write& write_block) const {
    const std::size_t stride = blocks_.size() * kBlockExtent;
    for (std::size_t x = 0; x < blocks_.size(); ++x) {
      write_block(blocks_[x], {&texels[x * kBlockExtent], stride});
    }
  }

  const Etc1sCodebooks& books_;
  std::size_t second_channel_;
  std::vector<Etc1sBlock> blocks_;
  std::optional<Etc1sSlice> first_, second_;
};

// --- A file ---

class Decoder {
 public:
  Decoder(const Job& job, std::span<const std::byte> bytes, const Ktx2& file)
      : job_(job), bytes_(bytes), file_(file) {}

  std::optional<DecodeError> prepare() {
    return file_.model == Ktx2Model::etc1s ? read_codebooks() : std::nullopt;
  }

  // Writes the first `channels` of a level's texels to `rows`; null: they are discarded.
  std::optional<DecodeError> decode(std::size_t level, std::uint32_t channels, Rows* rows) {
    const Extent extent = extent_of(level);
    if (file_.model == Ktx2Model::etc1s) return decode_basis(level, extent, channels, rows);
    return decode_uastc(level, extent, channels, rows);
  }

  Extent extent_of(std::size_t level) const {
    return {image::level_extent(file_.width, level), image::level_extent(file_.height, level)};
  }

  std::uint64_t reserved_blocks() const { return reserved_blocks_; }

 private:
  std::span<const std::byte> part(const Ktx2Range& range) const {
    return bytes_.subspan(static_cast<std::size_t>(range.offset),
                          static_cast<std::size_t>(range.length));
  }

  std::optional<DecodeError> read_codebooks() {
    const image::Ktx2Codebooks& parts = file_.codebooks;
    auto endpoints = read_endpoints(part(parts.endpoints), parts.endpoint_count);
    if (!endpoints) return corrupt("The codebook of endpoints is corrupt.");
    auto selectors = read_selectors(part(parts.selectors), parts.selector_count);
    if (!selectors) return corrupt("The codebook of selectors is corrupt.");
    auto codes = read_slice_codes(part(parts.slice_codes));
    if (!codes) return corrupt("The Huffman tables of the slices are corrupt.");
    basis_ = {{*std::move(endpoints), *std::move(selectors)}, *std::move(codes)};
    return std::nullopt;
  }

  std::optional<DecodeError> decode_basis(std::size_t level, const Extent& extent,
                                          std::uint32_t channels, Rows* rows) {
    const Ktx2Level& at = file_.levels[level];
    const std::size_t second = file_.contents == Channels::red_green ? 1 : 3;
    BasisRows blocks(basis_, part(at.first_slice), part(at.second_slice), second, extent);
    return copy(level, extent, channels, rows,
                [&blocks](std::span<Texel> texels) { return blocks.next(texels); });
  }

  std::optional<DecodeError> decode_uastc(std::size_t level, const Extent& extent,
                                          std::uint32_t channels, Rows* rows) {
    const Ktx2Level& at = file_.levels[level];
    const std::span<const std::byte> stored = part({at.offset, at.length});
    std::span<const std::byte> blocks = stored;
    std::unique_ptr<std::byte[]> own;
    if (file_.scheme == static_cast<std::uint32_t>(image::Ktx2Scheme::zstd)) {
      const auto size = static_cast<std::size_t>(at.uncompressed);
      if (exceeds_memory(job_, size, 1)) return no_memory();
      own.reset(new std::byte[size]);
      const std::size_t got = ZSTD_decompress(own.get(), size, stored.data(), stored.size());
      if (ZSTD_isError(got) != 0 || got != size) {
        return corrupt(level_name(level) + " is corrupt: its Zstandard data cannot be decoded.");
      }
      blocks = {own.get(), size};
    }
    if (blocks.size() / kUastcBlockBytes < extent.blocks()) {  // the header guaranteed them
      return corrupt(level_name(level) + " is truncated.");
    }
    return copy(level, extent, channels, rows, [this, &blocks, &extent](std::span<Texel> texels) {
      write_uastc_row(blocks, extent, texels);
      return true;
    });
  }

  // Takes a row of blocks from the begin of `blocks`.
  void write_uastc_row(std::span<const std::byte>& blocks, const Extent& extent,
                       std::span<Texel> texels) {
    const std::size_t across = extent.blocks_across();
    for (std::size_t x = 0; x < across; ++x) {
      const bool known = decode_uastc_block(blocks.first<kUastcBlockBytes>(),
                                            {&texels[x * kBlockExtent], across * kBlockExtent});
      if (!known) ++reserved_blocks_;
      blocks = blocks.subspan(kUastcBlockBytes);
    }
  }

  // Copies all rows of blocks, clipped to the level; discards them without `rows`.
  std::optional<DecodeError> copy(std::size_t level, const Extent& extent, std::uint32_t channels,
                                  Rows* rows, const NextRow& next) const {
    const std::size_t stride = extent.blocks_across() * kBlockExtent;
    if (exceeds_memory(job_, stride, kBlockExtent * sizeof(Texel))) return no_memory();
    std::vector<Texel> texels(stride * kBlockExtent, Texel{0, 0, 0, 255});
    for (std::uint32_t y = 0; y < extent.height; ++y) {
      const std::size_t row = y % kBlockExtent;
      if (row == 0 && !next(texels)) return corrupt(level_name(level) + " is corrupt.");
      if (rows == nullptr) continue;
      std::byte* to = rows->next();
      for (std::uint32_t x = 0; x < extent.width; ++x) {
        const Texel& texel = texels[row * stride + x];
        for (std::uint32_t c = 0; c < channels; ++c) *to++ = std::byte{texel[c]};
      }
    }
    return std::nullopt;
  }

  const Job& job_;
  std::span<const std::byte> bytes_;
  const Ktx2& file_;
  Basis basis_;
  std::uint64_t reserved_blocks_ = 0;
};

// R alone is grey. R and G get an undefined B, so that they keep their positions.
std::uint32_t channels_of(const Ktx2& file) {
  if (!file.contents) {
    return file.model == Ktx2Model::etc1s && file.channels.size() < 2 ? 3 : 4;
  }
  switch (*file.contents) {
    case Channels::red:
      return 1;
    case Channels::rgba:
      return 4;
    default:
      return 3;
  }
}

std::string first_error(const Ktx2& file) {
  for (const image::Ktx2Error& error : file.errors) {
    if (!error.tolerated) return error.problem;
  }
  return "Its texels are neither ETC1S with BasisLZ nor UASTC.";
}

}  // namespace

Answer decode_ktx2(const Job& job, std::span<const std::byte> bytes, const Output& output) {
  const Ktx2 file = image::read_ktx2(bytes);
  if (!image::has_known_texels(file)) return corrupt(first_error(file));
  if (job.level >= file.levels.size()) return corrupt("It has no such level.");
  Decoder decoder(job, bytes, file);
  const Extent extent = decoder.extent_of(job.level);
  Image image;
  image.width = extent.width;
  image.height = extent.height;
  image.channels = channels_of(file);
  if (image.texels() > job.max_pixels) return too_many_texels();
  if (auto error = decoder.prepare()) return *std::move(error);
  Rows rows(image, job, create_pixels(image, job, output));
  if (auto error = decoder.decode(job.level, image.channels, &rows)) return *std::move(error);
  for (std::size_t level = 0; level < file.levels.size() && !job.pixels; ++level) {
    if (level == job.level) continue;
    if (auto error = decoder.decode(level, image.channels, nullptr)) return *std::move(error);
  }
  image = rows.finish();
  if (decoder.reserved_blocks() > 0) {
    image.doubt =
        std::to_string(decoder.reserved_blocks()) + " of its blocks have a reserved mode.";
  }
  return image;
}

}  // namespace gltfx::codec
