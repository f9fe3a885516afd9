// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>
#include <vector>

#include <zlib.h>

#include "image_encode.hpp"

namespace gltfx::codec {
namespace {

using Buffer = std::vector<std::byte>;

constexpr std::array kSignature{0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A};
constexpr std::array<std::uint8_t, 5> kColorType{0, 0, 4, 2, 6};  // by number of channels
constexpr std::size_t kChunkBytes = 12;                           // length, type, checksum

void append_number(Buffer& to, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) to.push_back(std::byte(value >> shift & 0xFFU));
}

void append(Buffer& to, std::span<const std::byte> bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}

void append_chunk(Buffer& file, std::string_view type, std::span<const std::byte> content) {
  append_number(file, static_cast<std::uint32_t>(content.size()));
  const std::size_t begin = file.size();
  append(file, std::as_bytes(std::span(type)));
  append(file, content);
  const auto* bytes = reinterpret_cast<const Bytef*>(file.data() + begin);
  append_number(file, static_cast<std::uint32_t>(crc32_z(0, bytes, file.size() - begin)));
}

Buffer header(const Raster& raster) {
  Buffer content;
  append_number(content, raster.width);
  append_number(content, raster.height);
  content.push_back(std::byte(raster.bits));
  content.push_back(std::byte(kColorType[raster.channels]));
  content.resize(13);  // deflate, the only set of filters, not interlaced
  return content;
}

enum Filter : std::uint8_t { none, sub, up, average, paeth, count };

std::uint8_t paeth_of(int left, int above, int corner) {
  const int guess = left + above - corner;
  const int to_left = std::abs(guess - left);
  const int to_above = std::abs(guess - above);
  const int to_corner = std::abs(guess - corner);
  if (to_left <= to_above && to_left <= to_corner) return static_cast<std::uint8_t>(left);
  return static_cast<std::uint8_t>(to_above <= to_corner ? above : corner);
}

/// Rows with a guess taken off each byte (section 9), the one that leaves the least (section 12.7).
class Rows {
 public:
  explicit Rows(const Raster& raster)
      : texel_(std::size_t{raster.channels} * (raster.bits / 8)),
        size_(raster.width * texel_),
        swap_(raster.bits == 16 && std::endian::native == std::endian::little),
        above_(size_),
        row_(size_) {
    for (auto& each : filtered_) each.resize(size_ + 1);
  }

  std::size_t size() const { return size_; }

  /// The filter's number, then the bytes.
  std::span<const std::uint8_t> filter(std::span<const std::byte> texels) {
    above_.swap(row_);
    std::memcpy(row_.data(), texels.data(), size_);
    for (std::size_t i = 0; swap_ && i + 1 < size_; i += 2) std::swap(row_[i], row_[i + 1]);
    std::uint8_t best = none;
    std::uint64_t least = UINT64_MAX;
    for (std::uint8_t kind = none; kind < count; ++kind) {
      const std::uint64_t sum = apply(kind);
      if (sum < least) best = kind;
      least = std::min(least, sum);
    }
    return filtered_[best];
  }

 private:
  std::uint64_t apply(std::uint8_t kind) {
    std::vector<std::uint8_t>& out = filtered_[kind];
    out[0] = kind;
    const auto rest = [&](const auto& guess) {
      for (std::size_t i = 0; i < size_; ++i) {
        const bool first = i < texel_;
        const int left = first ? 0 : row_[i - texel_];
        const int corner = first ? 0 : above_[i - texel_];
        out[i + 1] = static_cast<std::uint8_t>(row_[i] - guess(left, int{above_[i]}, corner));
      }
    };
    switch (kind) {
      case none:
        std::memcpy(out.data() + 1, row_.data(), size_);
        break;
      case sub:
        rest([](int left, int, int) { return left; });
        break;
      case up:
        rest([](int, int above, int) { return above; });
        break;
      case average:
        rest([](int left, int above, int) { return (left + above) / 2; });
        break;
      default:
        rest(paeth_of);
    }
    std::uint64_t sum = 0;
    for (std::size_t i = 1; i <= size_; ++i) {
      sum += static_cast<std::uint64_t>(std::abs(static_cast<std::int8_t>(out[i])));
    }
    return sum;
  }

  std::size_t texel_, size_;
  bool swap_;
  std::vector<std::uint8_t> above_, row_;
  std::array<std::vector<std::uint8_t>, count> filtered_;
};

/// A zlib stream that grows as it is fed.
class Deflater {
 public:
  Deflater() {
    if (::deflateInit(&stream_, Z_DEFAULT_COMPRESSION) != Z_OK) throw std::bad_alloc();
  }
  ~Deflater() { ::deflateEnd(&stream_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  void feed(std::span<const std::uint8_t> bytes, int flush) {
    stream_.next_in = const_cast<Bytef*>(bytes.data());
    stream_.avail_in = static_cast<uInt>(bytes.size());
    int state = Z_OK;
    do {
      stream_.next_out = reinterpret_cast<Bytef*>(block_.data());
      stream_.avail_out = static_cast<uInt>(block_.size());
      state = ::deflate(&stream_, flush);
      append(out_, std::span(block_).first(block_.size() - stream_.avail_out));
    } while (stream_.avail_out == 0 || (flush == Z_FINISH && state == Z_OK));
  }
  const Buffer& bytes() const { return out_; }

 private:
  z_stream stream_{};
  std::array<std::byte, 65536> block_;
  Buffer out_;
};

}  // namespace

Answer encode_png(const Job& job, std::span<const std::byte> texels, Output& output) {
  constexpr std::size_t kMostInChunk = std::size_t{1} << 30U;
  Rows rows(job.raster);
  Deflater deflater;
  for (std::size_t at = 0; at < texels.size(); at += rows.size()) {
    deflater.feed(rows.filter(texels.subspan(at, rows.size())), Z_NO_FLUSH);
  }
  deflater.feed({}, Z_FINISH);
  std::span<const std::byte> data(deflater.bytes());
  Buffer file;
  file.reserve(data.size() + data.size() / kMostInChunk * kChunkBytes + 64);
  for (const int byte : kSignature) file.push_back(std::byte(byte));
  append_chunk(file, "IHDR", header(job.raster));
  while (!data.empty()) {
    const std::size_t size = std::min(data.size(), kMostInChunk);
    append_chunk(file, "IDAT", data.first(size));
    data = data.subspan(size);
  }
  append_chunk(file, "IEND", {});
  return hand_over(file, output);
}

}  // namespace gltfx::codec
