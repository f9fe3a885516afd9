// SPDX-License-Identifier: Apache-2.0
/// Reads a stream of bits, the lowest bit of each byte first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace gltfx::codec {

/// Returns zeros after the end; ok() is permanently false after such a bit was taken, or after
/// fail().
class BitReader {
 public:
  explicit BitReader(std::span<const std::byte> bytes)
      : bytes_(bytes), left_(std::uint64_t{bytes.size()} * 8) {}

  bool ok() const { return ok_; }
  void fail() { ok_ = false; }

  /// Returns the next `count` bits, at most 32, the first one lowest, without taking them.
  std::uint32_t peek(unsigned count) {
    if (held_ < count) refill();
    return static_cast<std::uint32_t>(bits_ & ((std::uint64_t{1} << count) - 1));
  }

  void skip(unsigned count) {
    if (held_ < count) refill();
    bits_ >>= count;
    held_ -= count;
    ok_ = ok_ && count <= left_;
    left_ -= count <= left_ ? count : left_;
  }

  std::uint32_t take(unsigned count) {
    const std::uint32_t value = peek(count);
    skip(count);
    return value;
  }

 private:
  void refill() {
    for (; held_ <= 56; held_ += 8) {
      if (next_ == bytes_.size()) continue;
      bits_ |= std::to_integer<std::uint64_t>(bytes_[next_++]) << held_;
    }
  }

  std::span<const std::byte> bytes_;
  std::size_t next_ = 0;
  std::uint64_t left_;  ///< remaining bits
  std::uint64_t bits_ = 0;
  unsigned held_ = 0;  ///< bits in `bits_`
  bool ok_ = true;
};

}  // namespace gltfx::codec
