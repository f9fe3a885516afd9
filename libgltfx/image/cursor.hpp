// SPDX-License-Identifier: Apache-2.0
/// Reads numbers of a header one after the other and records when the bytes end; the readers that
/// `read_header` calls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "image/header.hpp"

namespace gltfx::image {

/// Every read past the end gives 0 and makes ok() permanently false.
class Cursor {
 public:
  explicit Cursor(std::span<const std::byte> bytes) : bytes_(bytes) {}

  bool ok() const { return ok_; }
  std::size_t position() const { return at_; }
  std::size_t left() const { return bytes_.size() - at_; }

  std::uint8_t u8() { return static_cast<std::uint8_t>(read(1, true)); }
  std::uint16_t be16() { return static_cast<std::uint16_t>(read(2, true)); }
  std::uint32_t be32() { return read(4, true); }
  std::uint16_t le16() { return static_cast<std::uint16_t>(read(2, false)); }
  std::uint32_t le24() { return read(3, false); }
  std::uint32_t le32() { return read(4, false); }

  void skip(std::uint64_t count) {
    if (count > left()) {
      at_ = bytes_.size();
      ok_ = false;
    } else {
      at_ += static_cast<std::size_t>(count);
    }
  }

  /// Whether `text` is at the current position, which does not change.
  bool at(std::string_view text) const {
    return text.size() <= left() && std::memcmp(bytes_.data() + at_, text.data(), text.size()) == 0;
  }

 private:
  std::uint32_t read(std::size_t count, bool big_endian) {
    if (count > left()) {
      skip(count);
      return 0;
    }
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto byte = std::to_integer<std::uint32_t>(bytes_[at_ + i]);
      value = big_endian ? value << 8 | byte : value | byte << (8 * i);
    }
    at_ += count;
    return value;
  }

  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

HeaderResult read_png(std::span<const std::byte> bytes);
HeaderResult read_jpeg(std::span<const std::byte> bytes);
HeaderResult read_webp(std::span<const std::byte> bytes);
HeaderResult read_avif(std::span<const std::byte> bytes);

/// Whether a file begins with the box of an AVIF image.
bool is_avif(std::span<const std::byte> bytes);

inline HeaderError unexpected_end() { return {HeaderError::Kind::unexpected_end, {}}; }
inline HeaderError invalid(std::string problem) {
  return {HeaderError::Kind::invalid, std::move(problem)};
}

/// Records the first problem that makes readers refuse an image.
inline void doubt(Header& header, std::string problem) {
  if (header.doubt.empty()) header.doubt = std::move(problem);
}
/// Records the first problem that readers ignore, or handle differently.
inline void remark(Header& header, std::string problem, bool readers_differ) {
  if (!header.remark.empty() && header.readers_differ >= readers_differ) return;
  header.remark = std::move(problem);
  header.readers_differ = readers_differ;
}

}  // namespace gltfx::image
