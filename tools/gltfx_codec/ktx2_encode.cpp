// SPDX-License-Identifier: Apache-2.0
// KTX2 files for KHR_texture_basisu: UASTC with Zstandard and all mipmap levels.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <new>
#include <string_view>
#include <vector>

#include <zstd.h>

#include "image/ktx2.hpp"
#include "image_encode.hpp"
#include "resize.hpp"
#include "uastc_encode.hpp"

namespace gltfx::codec {
namespace {

using image::level_extent;

// Decompresses as fast as with any other level.
constexpr int kZstdLevel = 9;

// --- Levels ---

Texel texel_at(const Texels& texels, std::uint32_t x, std::uint32_t y) {
  const std::uint32_t channels = texels.raster.channels;
  const std::size_t first = (std::size_t{y} * texels.raster.width + x) * channels;
  const auto value = [&](std::uint32_t c) {
    return std::to_integer<std::uint8_t>(texels.bytes[first + c]);
  };
  Texel texel{value(0), value(0), value(0), 255};
  if (channels >= 3) texel = {value(0), value(1), value(2), 255};
  if (channels % 2 == 0) texel[3] = value(channels - 1);
  return texel;
}

// Blocks in rows from the top. Texels beyond the edges are those at the edges.
std::vector<std::byte> encode_blocks(const Texels& texels) {
  const Raster& raster = texels.raster;
  const std::size_t across = blocks_along(raster.width);
  const std::size_t down = blocks_along(raster.height);
  std::vector<std::byte> blocks(across * down * kUastcBlockBytes);
  std::span<std::byte> left(blocks);
  std::array<Texel, kBlockExtent * kBlockExtent> block{};
  for (std::size_t at = 0; at < across * down; ++at, left = left.subspan(kUastcBlockBytes)) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      const auto x = static_cast<std::uint32_t>(at % across * kBlockExtent + i % kBlockExtent);
      const auto y = static_cast<std::uint32_t>(at / across * kBlockExtent + i / kBlockExtent);
      block[i] = texel_at(texels, std::min(x, raster.width - 1), std::min(y, raster.height - 1));
    }
    encode_uastc_block(block, left.first<kUastcBlockBytes>());
  }
  return blocks;
}

std::vector<std::byte> compressed(std::span<const std::byte> bytes) {
  std::vector<std::byte> result(ZSTD_compressBound(bytes.size()));
  const std::size_t size =
      ZSTD_compress(result.data(), result.size(), bytes.data(), bytes.size(), kZstdLevel);
  if (ZSTD_isError(size) != 0) throw std::bad_alloc();
  result.resize(size);
  return result;
}

struct Level {
  std::vector<std::byte> bytes;
  std::uint64_t uncompressed = 0;
};

// All levels down to one texel, the largest first. A level is made from one that is up to eight
// times as large, not from the next larger one: each rounding and filter adds an error.
std::vector<Level> encode_levels(const Job& job, std::span<const std::byte> texels) {
  constexpr unsigned kLevelsOfSource = 3;
  const Raster& raster = job.raster;
  const auto count = static_cast<unsigned>(std::bit_width(std::max(raster.width, raster.height)));
  Texels source{raster, {texels.begin(), texels.end()}};
  Texels level = source;
  std::vector<Level> levels;
  for (unsigned i = 0; i < count; ++i) {
    if (i > 0) {
      const Size size{level_extent(raster.width, i), level_extent(raster.height, i)};
      level = resize(source.raster, source.bytes, size, job.resize);
      if (i % kLevelsOfSource == 0) source = level;
    }
    const std::vector<std::byte> blocks = encode_blocks(level);
    levels.push_back({compressed(blocks), blocks.size()});
  }
  return levels;
}

// --- File (KTX 2.0 section 3) ---

class FileWriter {
 public:
  template <typename Number>
  void number(Number value) {
    for (std::size_t i = 0; i < sizeof value; ++i) {
      bytes_.push_back(static_cast<std::byte>(value >> 8 * i & 0xFFU));
    }
  }
  void byte(std::uint8_t value) { bytes_.push_back(std::byte{value}); }
  void bytes(std::span<const std::byte> all) {
    bytes_.insert(bytes_.end(), all.begin(), all.end());
  }
  void text(std::string_view text) { bytes(std::as_bytes(std::span(text.data(), text.size()))); }
  std::span<const std::byte> all() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

constexpr std::uint32_t kHeaderBytes = 80;
constexpr std::uint32_t kLevelBytes = 24;
constexpr std::uint32_t kDescriptorBytes = 44;
constexpr std::string_view kWriter{"KTXwriter\0gltfx\0", 16};

// A basic block with one sample (Khronos Data Format 1.3, section 5).
void write_descriptor(FileWriter& file, bool color, bool alpha) {
  constexpr std::uint8_t kUastc = 166;
  file.number(kDescriptorBytes);
  file.number(std::uint32_t{0});  // vendor and type
  file.number(std::uint16_t{2});  // version
  file.number(static_cast<std::uint16_t>(kDescriptorBytes - 4));
  file.byte(kUastc);
  file.byte(color ? image::kKtx2PrimariesBt709 : 0);
  file.byte(color ? image::kKtx2TransferSrgb : image::kKtx2TransferLinear);
  file.byte(0);  // straight alpha
  for (const unsigned less_one : {3U, 3U, 0U, 0U}) file.byte(static_cast<std::uint8_t>(less_one));
  file.byte(kUastcBlockBytes);
  for (int plane = 1; plane < 8; ++plane) file.byte(0);
  file.number(std::uint16_t{0});  // bit offset
  file.byte(kUastcBlockBytes * 8 - 1);
  file.byte(alpha ? 3 : 0);       // RGBA or RGB
  file.number(std::uint32_t{0});  // position
  file.number(std::uint32_t{0});  // least value
  file.number(UINT32_MAX);
}

void write_header(FileWriter& file, const Raster& raster, std::uint32_t levels) {
  const std::uint32_t descriptor = kHeaderBytes + kLevelBytes * levels;
  file.text("\xABKTX 20\xBB\r\n\x1A\n");
  file.number(std::uint32_t{0});  // vkFormat
  file.number(std::uint32_t{1});  // typeSize
  file.number(raster.width);
  file.number(raster.height);
  file.number(std::uint32_t{0});  // depth
  file.number(std::uint32_t{0});  // layers
  file.number(std::uint32_t{1});  // faces
  file.number(levels);
  file.number(static_cast<std::uint32_t>(image::Ktx2Scheme::zstd));
  file.number(descriptor);
  file.number(kDescriptorBytes);
  file.number(descriptor + kDescriptorBytes);
  file.number(static_cast<std::uint32_t>(4 + kWriter.size()));
  file.number(std::uint64_t{0});  // no global data
  file.number(std::uint64_t{0});
}

// The smallest level is the first in the file and the last in the index.
FileWriter file_of(const Job& job, const std::vector<Level>& levels) {
  FileWriter file;
  const auto count = static_cast<std::uint32_t>(levels.size());
  write_header(file, job.raster, count);
  std::vector<std::uint64_t> offsets(levels.size());
  std::uint64_t end = kHeaderBytes + kLevelBytes * count + kDescriptorBytes + 4 + kWriter.size();
  for (std::size_t i = levels.size(); i-- > 0;) {
    offsets[i] = end;
    end += levels[i].bytes.size();
  }
  for (std::size_t i = 0; i < levels.size(); ++i) {
    file.number(offsets[i]);
    file.number(std::uint64_t{levels[i].bytes.size()});
    file.number(levels[i].uncompressed);
  }
  write_descriptor(file, job.resize.kind == TexelKind::color, job.raster.channels % 2 == 0);
  file.number(static_cast<std::uint32_t>(kWriter.size()));
  file.text(kWriter);
  for (std::size_t i = levels.size(); i-- > 0;) file.bytes(levels[i].bytes);
  return file;
}

}  // namespace

Answer encode_ktx2(const Job& job, std::span<const std::byte> texels, const Output& output) {
  const FileWriter file = file_of(job, encode_levels(job, texels));
  return hand_over(file.all(), output);
}

}  // namespace gltfx::codec
