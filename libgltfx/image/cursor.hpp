// SPDX-License-Identifier: Apache-2.0
/// Reads numbers of a header one after the other and remembers when the bytes ran out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace gltfx::image {

/// Every read past the end gives 0 and makes ok() false for good.
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

  /// Whether `text` stands here; does not move.
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

}  // namespace gltfx::image
